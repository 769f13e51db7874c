#include "tessera/job/mosaic_job.h"

#include "tessera/job/statistics.h"
#include "tessera/mosaic/run.h"

namespace tessera {
namespace {

constexpr int kAreaBins = 30;

Histogram areas_plot(const mosaic::Output& output) {
  Histogram plot = value_histogram("tiles", output.areas, kAreaBins);
  plot.title = "Areas of tiles";
  plot.x_label = "area, px²";
  plot.y_label = "number";
  return plot;
}

}  // namespace

Result<Outcome> run_mosaic_job(const Job& job, const Pictures& pictures, Rasterizer& rasterizer,
                               const RunContext& context, const IterationObserver& observer) {
  const auto& params = std::get<mosaic::Params>(job.params);
  const mosaic::Pictures given{picture_of(pictures, "photo"), picture_of(pictures, "edges"),
                               picture_of(pictures, "direction"), picture_of(pictures, "regions")};
  auto output = mosaic::run(given, params, job.seed, rasterizer, context, observer);
  if (!output) return tl::unexpected<Status>(std::move(output.error()));
  double covered = 0;
  for (const double area : output->areas) covered += area;
  Outcome outcome;
  outcome.counts = {{"tiles", static_cast<std::int64_t>(output->sheet.pieces.size())},
                    {"iterations", output->iterations},
                    {"reseeded", output->reseeded},
                    {"tiles_at_edges", output->at_edges},
                    {"tiles_across_edges", output->crossed}};
  outcome.metrics = {{"area_mean", mean_of(output->areas)},
                     {"area_cv", variation_of(output->areas)},
                     {"coverage", covered / (output->sheet.width * output->sheet.height)},
                     {"field_angle_deg", output->field_angle},
                     {"edge_angle_deg", output->edge_angle}};
  outcome.plots.push_back({"areas", areas_plot(*output)});
  outcome.sheet = std::move(output->sheet);
  return outcome;
}

}  // namespace tessera
