#include "tessera/job/pebbles_job.h"

#include <fmt/format.h>

#include <cmath>

#include "tessera/job/statistics.h"
#include "tessera/pebbles/overlay.h"
#include "tessera/pebbles/run.h"

namespace tessera {
namespace {

constexpr int kSizeBins = 30;
constexpr int kPercents[] = {16, 50, 84};
constexpr int kMostLabels = 65535;  // of a 16-bit picture

Histogram sizes_plot(const std::vector<double>& b_axes) {
  Histogram plot = value_histogram("pebbles", b_axes, kSizeBins);
  plot.title = "Grain sizes";
  plot.x_label = "b axis, mm";
  plot.y_label = "number";
  return plot;
}

// As field science draws them: what part of the grains, and of the area that they cover, is finer than a size.
Curves cumulative_plot(const std::vector<double>& b_axes, const std::vector<pebbles::Grain>& grains) {
  std::vector<double> areas;
  for (const pebbles::Grain& grain : grains) areas.push_back(grain.area);
  Curves plot{"Grain sizes", "b axis, mm", "finer, %", true, {}, {}};
  plot.series = {{"by number", cumulative(b_axes)}, {"by area", cumulative(b_axes, areas)}};
  for (const int percent : kPercents) {
    const double size = pebbles::percentile(b_axes, percent / 100.0);
    if (size > 0)
      plot.marks.push_back({fmt::format("D{} {:.3g} mm, psi {:.2f}", percent, size, std::log2(size)),
                            {size, static_cast<double>(percent)}});
  }
  return plot;
}

Raster labels_raster(const cv::Mat1i& labels) {
  Raster raster{labels.cols, labels.rows, 1, 16, {}};
  raster.bytes.reserve(2 * labels.total());
  for (const int label : labels) {
    const int number = label <= kMostLabels ? label : 0;
    raster.bytes.push_back(static_cast<std::uint8_t>(number >> 8));
    raster.bytes.push_back(static_cast<std::uint8_t>(number & 255));
  }
  return raster;
}

// What field science wants to know of each grain, in the order of the pieces.
std::vector<Column> grain_columns(const std::vector<pebbles::Grain>& grains, double mm_per_px) {
  std::vector<Column> columns = {{"a_px", {}}, {"b_px", {}},     {"a_axis_deg", {}}, {"a_mm", {}},
                                 {"b_mm", {}}, {"area_mm2", {}}, {"psi", {}}};
  for (const pebbles::Grain& grain : grains) {
    const double values[] = {grain.a,
                             grain.b,
                             grain.orientation_deg,
                             grain.a * mm_per_px,
                             grain.b * mm_per_px,
                             grain.area * mm_per_px * mm_per_px,
                             std::log2(grain.b * mm_per_px)};
    for (std::size_t c = 0; c < columns.size(); ++c) columns[c].values.push_back(values[c]);
  }
  return columns;
}

}  // namespace

Result<Outcome> run_pebbles_job(const Job& job, const Pictures& pictures, Rasterizer& /*rasterizer*/,
                                const RunContext& context, const IterationObserver& /*observer*/) {
  const ImageView& photo = pictures.at("photo");
  auto output = pebbles::run({photo, picture_of(pictures, "segmentation")}, std::get<pebbles::Params>(job.params),
                             job.seed, context);
  if (!output) return tl::unexpected<Status>(std::move(output.error()));
  const double mm_per_px = 1000 * output->metres_per_px;
  if (output->pebbles.size() > kMostLabels)
    context.warn("a label picture counts to 65535; pebbles beyond that are ground in it");

  Outcome outcome;
  std::vector<double> b_axes;
  double covered = 0;
  for (const pebbles::Grain& grain : output->grains) b_axes.push_back(grain.b * mm_per_px);
  for (const pebbles::Pebble& pebble : output->pebbles) covered += pebble.area_px;
  outcome.counts = {{"pebbles", static_cast<std::int64_t>(output->pebbles.size())}};
  outcome.metrics = {{"coverage", covered / (static_cast<double>(photo.width) * photo.height)},
                     {"mm_per_px", mm_per_px}};
  for (const int percent : kPercents) {
    const double size = pebbles::percentile(b_axes, percent / 100.0);
    outcome.metrics["d" + std::to_string(percent) + "_mm"] = size;
    if (size > 0) outcome.metrics["d" + std::to_string(percent) + "_psi"] = std::log2(size);
  }
  outcome.plots = {{"sizes", sizes_plot(b_axes)}, {"cumulative", cumulative_plot(b_axes, output->grains)}};
  outcome.rasters = {{"labels.png", [labels = output->labels] { return labels_raster(labels); }},
                     {"overlay.png", [pixels = photo.mat().clone(), pebbles = std::move(output->pebbles)] {
                        return pebbles::overlay(pixels, pebbles);
                      }}};
  outcome.sheet = std::move(output->sheet);
  outcome.sheet.columns = grain_columns(output->grains, mm_per_px);
  outcome.scene = std::move(output->scene);
  return outcome;
}

}  // namespace tessera
