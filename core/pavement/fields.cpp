#include "tessera/pavement/fields.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/noise.hpp>
#include <opencv2/imgproc.hpp>

#include "tessera/base/portable_math.h"
#include "tessera/base/rng.h"

namespace tessera::pavement {
namespace {

Zones make_zones(const cv::Mat3b& drawing, const Params& params) {
  return params.colors == 2 ? black_and_white(drawing, params.threshold) : colour_zones(drawing, params.colors);
}

// Lines one or two pixels wide are all staircase; twice the pixels give them a width and a direction.
int choose_supersample(const Zones& zones, const Params& params) {
  if (params.supersample > 0) return params.supersample;
  return supersample_for(thin_pixels(zones.map, {0, zones.map.rows}), static_cast<double>(zones.map.total()));
}

// The drawing with `scale` pixels a pixel, and its zones. Smoothing would widen or narrow hairlines, so black keeps
// its share of the picture instead of the threshold its level.
Zones supersampled_zones(const cv::Mat3b& drawing, const Zones& zones, int scale, const Params& params) {
  const cv::Mat3b scaled = supersampled(drawing, scale);
  Params same_share = params;
  if (params.colors == 2) {
    const double black = 1 - cv::sum(zones.map)[0] / static_cast<double>(zones.map.total());
    GreyHistogram histogram{};
    add_levels(grey_of(scaled), histogram);
    same_share.threshold = threshold_for_share(histogram, black);
  }
  return make_zones(scaled, same_share);
}

}  // namespace

std::int64_t thin_pixels(const cv::Mat1b& zones, cv::Range rows) {
  const cv::Mat square = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
  cv::Mat1b solid, most;  // a square's centre: the least zone there is the greatest
  cv::erode(zones, solid, square, {-1, -1}, 1, cv::BORDER_REPLICATE);
  cv::dilate(zones, most, square, {-1, -1}, 1, cv::BORDER_REPLICATE);
  cv::compare(solid, most, solid, cv::CMP_EQ);
  cv::dilate(solid, most, square, {-1, -1}, 1, cv::BORDER_REPLICATE);
  return std::int64_t{rows.size()} * zones.cols - cv::countNonZero(most.rowRange(rows));
}

int supersample_for(std::int64_t thin, double pixels) {
  constexpr double kThinShare = 0.002;
  constexpr double kMostPixels = 1e8;  // of a drawing that may be made larger unasked
  return pixels <= kMostPixels && static_cast<double>(thin) > kThinShare * pixels ? 2 : 1;
}

cv::Mat3b supersampled(const cv::Mat3b& drawing, int scale) {
  cv::Mat3b scaled;
  cv::GaussianBlur(drawing, scaled, {5, 5}, 0.8, 0.8, cv::BORDER_REPLICATE);
  cv::resize(scaled, scaled, {}, scale, scale, cv::INTER_CUBIC);
  return scaled;
}

NoiseDirection::NoiseDirection(cv::Size picture, double half_side, double noise_scale, std::uint64_t seed)
    : picture_(picture), half_side_(half_side), field_(picture, 2 * half_side), far_(field_.nodes().size(), 0) {
  Rng rng(seed, RngPurpose::kNoise);
  const float offset[] = {static_cast<float>(rng.uniform(0, 200)), static_cast<float>(rng.uniform(0, 200)),
                          static_cast<float>(rng.uniform(0, 200)), static_cast<float>(rng.uniform(0, 200))};
  const double wavelength = 2 * half_side * noise_scale;
  const float step = static_cast<float>(field_.step() / wavelength);
  cv::Mat2f& nodes = field_.nodes();
  for (int j = 0; j < nodes.rows; ++j)
    for (int i = 0; i < nodes.cols; ++i)
      nodes(j, i) = {glm::perlin(glm::vec2(offset[0] + i * step, offset[1] + j * step)),
                     glm::perlin(glm::vec2(offset[2] + i * step, offset[3] + j * step))};
}

void NoiseDirection::look_at(const DistanceField& distance, int first_row, cv::Range rows) {
  const double spacing = field_.step(), far = 3 * half_side_;
  for (int j = static_cast<int>(rows.start / spacing); j < far_.rows; ++j) {
    const int y = static_cast<int>(j * spacing);
    if (y < rows.start) continue;
    if (y >= rows.end) break;
    for (int i = 0; i < far_.cols; ++i) {
      const int x = static_cast<int>(i * spacing);
      far_(j, i) = x < distance.cols && distance(y - first_row, x) >= far;
    }
  }
}

void NoiseDirection::balance() {
  constexpr int kRounds = 12;
  constexpr double kGain = 0.3;  // about the noise's own size
  cv::Mat2f& nodes = field_.nodes();
  const double spacing = field_.step();
  for (int round = 0; round < kRounds; ++round) {
    cv::Vec2d sum(0, 0);
    std::int64_t count = 0;
    for (int j = 0; j < nodes.rows; ++j) {
      for (int i = 0; i < nodes.cols; ++i) {
        if (!far_(j, i)) continue;
        const int x = static_cast<int>(i * spacing), y = static_cast<int>(j * spacing);
        ++count;
        // Stones at the picture's border line up with it whatever the noise says.
        if (i == 0 || j == 0 || x + spacing >= picture_.width || y + spacing >= picture_.height)
          sum += cv::Vec2d(1, 0);
        const cv::Vec2d v = nodes(j, i);
        const double size = std::sqrt(v.dot(v));
        if (size > 0) sum += v * (1 / size);
      }
    }
    if (count == 0) return;
    const cv::Vec2d off = sum * (kGain / static_cast<double>(count));
    for (cv::Vec2f& v : nodes) v -= cv::Vec2f(static_cast<float>(off[0]), static_cast<float>(off[1]));
  }
}

NoiseDirection noise_of(const Fields& fields, const Params& params, std::uint64_t seed) {
  NoiseDirection noise(fields.distance.size(), fields.half_side, params.noise_scale, seed);
  noise.look_at(fields.distance, 0, {0, fields.distance.rows});
  noise.balance();
  return noise;
}

int Fields::zone_at(double x, double y) const {
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  return i < 0 || j < 0 || i >= zones.map.cols || j >= zones.map.rows ? -1 : zones.map(j, i);
}

Point Fields::inside(double x, double y) const {
  return {std::clamp<double>(x, 0, zones.map.cols), std::clamp<double>(y, 0, zones.map.rows)};
}

double Fields::distance_near(double x, double y) const {
  return distance(std::clamp(static_cast<int>(y), 0, distance.rows - 1),
                  std::clamp(static_cast<int>(x), 0, distance.cols - 1));
}

void Fields::prefetch(double x, double y) const {
  const int i = std::clamp(static_cast<int>(x), 0, distance.cols - 1),
            j = std::clamp(static_cast<int>(y), 0, distance.rows - 1);
  __builtin_prefetch(&distance(j, i));
  __builtin_prefetch(&zones.map(j, i));
}

double Fields::half_width_at(double x, double y, double cap) const {
  int i = std::clamp(static_cast<int>(std::floor(x)), 0, distance.cols - 1);
  int j = std::clamp(static_cast<int>(std::floor(y)), 0, distance.rows - 1);
  const int zone = zones.map(j, i), steps = static_cast<int>(std::ceil(cap)) + 1;
  for (int k = 0; k < steps && distance(j, i) < cap; ++k) {
    int best_i = i, best_j = j;
    for (int y1 = std::max(0, j - 1); y1 <= std::min(distance.rows - 1, j + 1); ++y1)
      for (int x1 = std::max(0, i - 1); x1 <= std::min(distance.cols - 1, i + 1); ++x1)
        if (distance(y1, x1) > distance(best_j, best_i) && zones.map(y1, x1) == zone) best_i = x1, best_j = y1;
    if (best_i == i && best_j == j) break;
    i = best_i;
    j = best_j;
  }
  return std::min<double>(cap, distance(j, i));
}

double half_length(double half_width, double half_side) {
  // In a band wider than a stone it keeps a stone's area; in a line it is half as long again as wide, but no crumb.
  if (half_width > half_side) return half_side * half_side / half_width;
  return std::clamp(1.5 * half_width, 0.3 * half_side, half_side);
}

Fields fields_of(Zones zones, int scale, const Params& params) {
  Fields fields;
  fields.zones = std::move(zones);
  fields.scale = scale;
  fields.half_side = params.half_side * scale;
  fields.distance =
      params.distance == Distance::kExact ? exact_distance(fields.zones.map) : chamfer_distance(fields.zones.map);
  return fields;
}

Fields make_fields(const ImageView& drawing, const Params& params) {
  Zones zones = make_zones(drawing.mat(), params);
  const int scale = choose_supersample(zones, params);
  if (scale > 1) zones = supersampled_zones(drawing.mat(), zones, scale, params);
  return fields_of(std::move(zones), scale, params);
}

}  // namespace tessera::pavement
