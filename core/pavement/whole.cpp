#include "tessera/pavement/whole.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tessera::pavement {
namespace {

// The part with `scale` pixels a pixel; what lies around it counts where it is smoothed.
cv::Mat3b scaled_part(const RowWindow& rows, cv::Rect part, int scale) {
  if (scale == 1) return rows.part(part);
  const cv::Rect picture({0, 0}, rows.size());
  const cv::Point margin(kPartMargin, kPartMargin);
  const cv::Rect around = cv::Rect(part.tl() - margin, part.br() + margin) & picture;
  const cv::Rect inner((part.tl() - around.tl()) * scale, part.size() * scale);
  return supersampled(rows.part(around), scale)(inner).clone();  // a picture of its own, as RowWindow::part() is
}

// Strips of whole rows, one after the other.
class Strips {
 public:
  Strips(RowSource& source, int margin, const RunContext& context)
      : context_(context),
        size_(source.size()),
        margin_(margin),
        rows_(source, rows_of(size_) + 2 * margin + 2 * kPartMargin) {}

  // visit(rows at hand, the strip, and it with the margin above and below), source pixels.
  template <class Visit>
  Result<void> each(const Visit& visit) {
    if (auto done = rows_.rewind(); !done) return done;
    for (int y = 0; y < size_.height; y += rows_of(size_)) {
      if (auto go_on = context_.check(); !go_on) return go_on;
      const int end = std::min(y + rows_of(size_), size_.height);
      const int from = std::max(0, y - margin_), to = std::min(end + margin_, size_.height);
      if (auto done = rows_.show(from - kPartMargin, to + kPartMargin); !done) return done;
      visit(rows_, cv::Rect(0, y, size_.width, end - y), cv::Rect(0, from, size_.width, to - from));
    }
    return {};
  }

 private:
  // Rows of a strip: a few million pixels.
  static int rows_of(cv::Size size) { return std::max(16, (1 << 22) / size.width); }

  const RunContext& context_;
  cv::Size size_;
  int margin_;
  RowWindow rows_;
};

// The rule of the drawing with `scale` pixels a pixel; `threshold` of two zones as of Params, or for their share.
struct RuleFinder {
  Strips& strips;
  const Params& params;
  cv::Size source;

  Result<ZoneRule> operator()(int scale, double black_share) const {
    GreyHistogram histogram{};
    cv::Mat1f samples(0, 3);
    auto looked = strips.each([&](const RowWindow& rows, cv::Rect strip, cv::Rect) {
      const cv::Mat3b part = scaled_part(rows, strip, scale);
      if (params.colors == 2) {
        add_levels(grey_of(part), histogram);
      } else {
        add_samples(part, source * scale, strip.y * scale, samples);
      }
    });
    if (!looked) return tl::unexpected(looked.error());
    if (params.colors != 2) return colour_rule(samples, params.colors);
    ZoneRule rule =
        two_zones(histogram, black_share < 0 ? params.threshold : threshold_for_share(histogram, black_share));
    Crossings crossings;
    looked = strips.each([&](const RowWindow& rows, cv::Rect strip, cv::Rect) {
      add_crossings(grey_of(scaled_part(rows, strip, scale)), rule, crossings);
    });
    if (!looked) return tl::unexpected(looked.error());
    smooth_as(crossings, rule);
    return rule;
  }
};

}  // namespace

Fields fields_of_part(const RowWindow& rows, cv::Rect part, const Whole& whole, const Params& params) {
  Fields fields = fields_of(divide(scaled_part(rows, part, whole.scale), whole.rule), whole.scale, params);
  fields.origin = part.tl() * whole.scale;
  return fields;
}

Result<Whole> look_through(RowSource& source, const Params& params, std::uint64_t seed, const RunContext& context) {
  const cv::Size size = source.size();
  const double pixels = static_cast<double>(size.width) * size.height;
  const int margin = kPartMargin + static_cast<int>(std::ceil(3 * params.half_side));
  Strips strips(source, margin, context);
  const RuleFinder find_rule{strips, params, size};
  auto rule = find_rule(1, -1);
  if (!rule) return tl::unexpected(rule.error());

  int scale = params.supersample;
  double white = 0;
  if (scale != 1) {
    std::int64_t thin = 0;
    auto looked = strips.each([&](const RowWindow& rows, cv::Rect strip, cv::Rect wide) {
      const cv::Mat1b zones = divide(rows.part(wide), *rule).map;
      const cv::Range core(strip.y - wide.y, strip.y - wide.y + strip.height);
      thin += thin_pixels(zones, core);
      white += cv::sum(zones.rowRange(core))[0];
    });
    if (!looked) return tl::unexpected(looked.error());
    if (scale == 0) scale = supersample_for(thin, pixels);
  }
  if (scale > 1) rule = find_rule(scale, 1 - white / pixels);
  if (!rule) return tl::unexpected(rule.error());

  Whole whole{size, scale, *std::move(rule),
              NoiseDirection(size * scale, params.half_side * scale, params.noise_scale, seed)};
  auto looked = strips.each([&](const RowWindow& rows, cv::Rect strip, cv::Rect wide) {
    const Fields fields = fields_of_part(rows, wide, whole, params);
    whole.noise.look_at(fields.distance, fields.origin.y, {strip.y * scale, strip.br().y * scale});
  });
  if (!looked) return tl::unexpected(looked.error());
  whole.noise.balance();
  return whole;
}

}  // namespace tessera::pavement
