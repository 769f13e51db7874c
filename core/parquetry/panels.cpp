#include "tessera/parquetry/panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tessera/image/resample.h"
#include "tessera/parquetry/markers.h"
#include "tessera/parquetry/wood_mask.h"

namespace tessera::parquetry {
namespace {

constexpr double kInchMm = 25.4;
constexpr double kFinestDpi = 150;   // of matching, where nobody asks for more
constexpr double kBesideMarkMm = 1;  // not used around a fiducial

struct Source {
  Scan scan;
  PanelOptions options;
  double dpi;
};

tl::unexpected<Status> refuse(const Source& source, std::string message) {
  return fail(StatusCode::kInvalidInput, source.scan.name, std::move(message));
}

double dpi_of(const Scan& scan, const PanelOptions& options, const RunContext& context) {
  constexpr double kScreens[] = {72, 96};  // what programs write that know no resolution
  if (options.dpi > 0) return options.dpi;
  const double dpi = scan.picture.dpi > 0 ? scan.picture.dpi : kUnknownDpi;
  const auto size = [&] {
    return fmt::format("{:.1f} x {:.1f} mm", scan.picture.width * kInchMm / dpi, scan.picture.height * kInchMm / dpi);
  };
  if (scan.picture.dpi <= 0)
    context.warn(fmt::format("{}: the scan tells no resolution; taken as {} dpi, it is {} (expected dpi=N)",
                             scan.name, kUnknownDpi, size()));
  else if (std::any_of(std::begin(kScreens), std::end(kScreens), [&](double d) { return std::abs(dpi - d) < 0.5; }))
    context.warn(
        fmt::format("{}: the scan tells {:.4g} dpi, which is rarely true; it is taken as {} (dpi=N changes "
                    "that)",
                    scan.name, dpi, size()));
  return dpi;
}

std::vector<Source> sources_of(const std::vector<Scan>& scans, const Params& params, const RunContext& context) {
  const std::vector<PanelOptions> all = read_panel_options(params.panels);
  std::vector<Source> sources;
  for (const Scan& scan : scans) {
    const auto own = std::find_if(all.begin(), all.end(), [&](const PanelOptions& o) { return o.name == scan.name; });
    const PanelOptions options = own != all.end() ? *own : PanelOptions{};
    sources.push_back({scan, options, dpi_of(scan, options, context)});
  }
  return sources;
}

// That of all panels together.
double common_dpi(const std::vector<Source>& sources, const Params& params) {
  if (params.resolution_dpi > 0) return params.resolution_dpi;
  double dpi = kFinestDpi;
  for (const Source& source : sources) dpi = std::min(dpi, source.dpi);
  return dpi;
}

// Pixels of the scan to one of the panel, in thousandths of dpi.
Ratio step_of(double scan_dpi, double dpi) { return {std::llround(1000 * scan_dpi), std::llround(1000 * dpi)}; }

cv::Size size_at(const ImageView& picture, Ratio step) {
  const auto side = [&](std::int64_t px) {
    return static_cast<int>(std::max<std::int64_t>(1, (px * step.under + step.over - 1) / step.over));
  };
  return {side(picture.width), side(picture.height)};
}

// 255 where all of a panel's pixel is wood. `white` is of the scan's proportions, not necessarily of its size.
cv::Mat1b wood_of(const cv::Mat1b& white, const ImageView& scan, Ratio step, cv::Size size) {
  const cv::Mat1b binary = white >= 128;
  cv::Mat3b three;
  cv::merge(std::vector<cv::Mat1b>(3, binary), three);
  const ImageView view{three.ptr(), three.cols, three.rows, static_cast<std::ptrdiff_t>(three.step)};
  const cv::Mat3b means = resampled(view, {step.over * white.cols, step.under * scan.width},
                                    {step.over * white.rows, step.under * scan.height}, size);
  cv::Mat1b wood;
  cv::extractChannel(means, wood, 0);
  return wood >= 254;
}

Result<cv::Mat1b> mask_of(const Source& source, Ratio step, const Panel& panel) {
  const ImageView& scan = source.scan.picture;
  const ImageView& mask = source.scan.mask;
  if (mask.pixels) {
    constexpr double kApart = 0.01;
    const double across = static_cast<double>(mask.width) / scan.width;
    const double down = static_cast<double>(mask.height) / scan.height;
    if (std::abs(across / down - 1) > kApart)
      return refuse(source, fmt::format("has a mask of {} x {} px for a scan of {} x {} px, expected the same "
                                        "proportions",
                                        mask.width, mask.height, scan.width, scan.height));
    cv::Mat1b grey;
    cv::cvtColor(mask.mat(), grey, cv::COLOR_RGB2GRAY);
    return wood_of(grey, scan, step, panel.scan.size());
  }
  if (scan.alpha) {
    const cv::Mat1b alpha(scan.height, scan.width, const_cast<std::uint8_t*>(scan.alpha));
    return wood_of(alpha, scan, step, panel.scan.size());
  }
  return find_wood(panel.scan, panel.mm_per_px);
}

// Takes the margin off the wood, at the scan's border too, and what is near a fiducial.
void trim(Panel& panel, double margin_mm) {
  const auto px = [&](double mm) { return mm / panel.mm_per_px; };
  for (const Point mark : panel.fiducials)
    cv::circle(panel.mask, cv::Point(static_cast<int>(mark.x), static_cast<int>(mark.y)),
               static_cast<int>(std::ceil(px(panel.fiducial_mm / 2 + kBesideMarkMm))), 0, cv::FILLED);
  if (margin_mm <= 0) return;
  cv::Mat1b framed;
  cv::Mat1f inside;
  cv::copyMakeBorder(panel.mask, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  cv::distanceTransform(framed, inside, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  const cv::Mat1b kept = inside > px(margin_mm);
  kept(cv::Rect(1, 1, panel.mask.cols, panel.mask.rows)).copyTo(panel.mask);
}

Point seen_by_cutter(const Panel& panel, Side side, Point px) {
  const Point mm = panel.mm_per_px * px;
  return side == Side::kBack ? Point{panel.width_mm() - mm.x, mm.y} : mm;
}

Result<void> lay_on_machine(const Source& source, const Params& params, Panel& panel) {
  const std::vector<Point>& machine = source.options.machine;
  if (machine.empty()) return {};
  std::vector<Point> seen;
  for (const Point mark : panel.fiducials) seen.push_back(seen_by_cutter(panel, params.side, mark));
  std::optional<Fitted> fitted;
  if (source.options.marks)
    fitted = fit(seen, machine, params.registration);
  else if (seen.size() >= machine.size())
    fitted = fit_unordered(seen, machine, params.registration);
  else
    return refuse(source,
                  fmt::format("shows {} round marks, expected the {} that lie on the machine (or marks=x:y,...)",
                              seen.size(), machine.size()));
  if (!fitted)
    return refuse(source,
                  "has no marks as far apart as those on the machine, expected the same ones (and the same dpi)");
  if (auto good = check_fit(*fitted, source.scan.name); !good) return good;
  panel.registered = true;
  panel.to_machine = fitted->map;
  panel.residuals = fitted->residuals;
  return {};
}

// Its marks: those that people name, or those that show.
void mark(const Source& source, Panel& panel) {
  constexpr double kUsualMarkMm = 5;  // of one that nobody has seen
  const std::vector<Marker> markers = find_markers(panel.scan, panel.mm_per_px);
  panel.fiducial_mm = markers.empty() ? kUsualMarkMm : markers.front().diameter * panel.mm_per_px;
  if (source.options.marks)
    for (const Point at : *source.options.marks) panel.fiducials.push_back((1 / panel.scan_px) * at);
  else
    for (const Marker& marker : markers) panel.fiducials.push_back(marker.at);
}

// What is found on a scan.
Result<Panel> found_on(const Source& source, double dpi) {
  Panel panel;
  panel.name = source.scan.name;
  panel.mm_per_px = kInchMm / dpi;
  panel.scan_px = source.dpi / dpi;
  const Ratio step = step_of(source.dpi, dpi);
  panel.scan = resampled(source.scan.picture, step, step, size_at(source.scan.picture, step));
  auto mask = mask_of(source, step, panel);
  if (!mask) return tl::unexpected<Status>(std::move(mask.error()));
  panel.mask = *mask;
  mark(source, panel);
  return panel;
}

Result<void> prepare(const Source& source, const Params& params, Panel& panel) {
  trim(panel, source.options.margin_mm);
  if (cv::countNonZero(panel.mask) == 0) return refuse(source, "has no wood within its mask, expected some");
  return lay_on_machine(source, params, panel);
}

// What is found on each scan, and what `then` makes of it.
template <class Then>
Result<std::vector<Panel>> panels_of(const std::vector<Scan>& scans, const Params& params, const RunContext& context,
                                     const Then& then) {
  const std::vector<Source> sources = sources_of(scans, params, context);
  const double dpi = common_dpi(sources, params);
  std::vector<Panel> panels;
  for (const Source& source : sources) {
    if (auto go_on = context.check(); !go_on) return tl::unexpected<Status>(std::move(go_on.error()));
    auto panel = found_on(source, dpi);
    if (!panel) return tl::unexpected<Status>(std::move(panel.error()));
    if (auto good = then(source, *panel); !good) return tl::unexpected<Status>(std::move(good.error()));
    panels.push_back(*std::move(panel));
  }
  return panels;
}

}  // namespace

Result<std::vector<Panel>> take_in(const std::vector<Scan>& scans, const Params& params, const RunContext& context) {
  return panels_of(scans, params, context,
                   [&](const Source& source, Panel& panel) { return prepare(source, params, panel); });
}

Result<std::vector<Panel>> look_at(const std::vector<Scan>& scans, const Params& params, const RunContext& context) {
  return panels_of(scans, params, context, [](const Source&, Panel&) { return Result<void>(); });
}

double mm_per_px_of(const std::vector<Scan>& scans, const Params& params) {
  return kInchMm / common_dpi(sources_of(scans, params, {}), params);
}

Point on_sheet(const Panel& panel, Side side, Point px) {
  const Point seen = seen_by_cutter(panel, side, px);
  return panel.registered ? panel.to_machine(seen) : seen;
}

}  // namespace tessera::parquetry
