#include "tessera/job/pattern_job.h"

#include "tessera/job/statistics.h"
#include "tessera/patterns/run.h"

namespace tessera {
namespace {

constexpr int kAreaBins = 30;

Histogram areas_plot(const patterns::Output& output) {
  Histogram plot = value_histogram(output.sheet.layer, output.areas, kAreaBins);
  plot.title = "Areas of " + output.sheet.layer;
  plot.x_label = "area, px²";
  plot.y_label = "number";
  return plot;
}

}  // namespace

Result<Outcome> run_pattern_job(const Job& job, const Pictures& pictures, Rasterizer& /*rasterizer*/,
                                const RunContext& context, const IterationObserver& /*observer*/) {
  const auto& params = std::get<patterns::Params>(job.params);
  const ImageView density = picture_of(pictures, "density");
  if (density.pixels && params.process != patterns::Process::kCox)
    context.warn("the density is not looked at: only the cox process has one");
  auto output = patterns::run(density, params, job.seed, context);
  if (!output) return tl::unexpected<Status>(std::move(output.error()));

  Outcome outcome;
  const double window = output->sheet.width * output->sheet.height;
  outcome.counts = {{output->sheet.layer, static_cast<std::int64_t>(output->sheet.pieces.size())}};
  outcome.metrics = {{"area_mean", mean_of(output->areas)},
                     {"area_cv", variation_of(output->areas)},
                     {"driving_intensity", output->intensity},
                     {"pieces_per_px2", static_cast<double>(output->sheet.pieces.size()) / window}};
  outcome.plots.push_back({"areas", areas_plot(*output)});
  if (patterns::has_finish(params))
    outcome.finish = [params, seed = job.seed](Raster& picture) { patterns::finish(picture, params, seed); };
  outcome.sheet = std::move(output->sheet);
  return outcome;
}

}  // namespace tessera
