#include "tessera/job/pavement_job.h"

#include <fmt/format.h>

#include <algorithm>

#include "tessera/job/statistics.h"
#include "tessera/pavement/run.h"

namespace tessera {
namespace {

constexpr int kAreaBins = 30;

std::map<std::string, std::int64_t> counts_of(const pavement::Output& output) {
  std::map<std::string, std::int64_t> counts = {
      {"stones", output.sheet.pieces.size()}, {"sites", output.sites}, {"reseeded", output.reseeded}};
  for (const int vertices : output.vertices_after) ++counts[fmt::format("stones_with_{}_vertices", vertices)];
  return counts;
}

std::map<std::string, double> metrics_of(const pavement::Output& output) {
  const auto& vertices = output.vertices_after;
  if (vertices.empty()) return {};
  const auto quads = static_cast<double>(std::count(vertices.begin(), vertices.end(), 4));
  return {{"area_mean", mean_of(output.areas)},
          {"area_cv", variation_of(output.areas)},
          {"quad_fraction", quads / static_cast<double>(vertices.size())}};
}

// Fig. 9.
Histogram vertices_plot(const pavement::Output& output) {
  Histogram plot = count_histogram({{"cells", output.vertices_before}, {"stones", output.vertices_after}});
  plot.title = "Vertices of cells and of stones";
  plot.x_label = "vertices";
  plot.y_label = "number";
  return plot;
}

// Fig. 12.
Histogram areas_plot(const pavement::Output& output) {
  Histogram plot = value_histogram("stones", output.areas, kAreaBins);
  plot.title = "Areas of stones";
  plot.x_label = "area, px²";
  plot.y_label = "number";
  return plot;
}

}  // namespace

Result<Outcome> run_pavement_job(const Job& job, const Pictures& pictures, Rasterizer& rasterizer,
                                 const RunContext& context, const IterationObserver& observer) {
  const auto& params = std::get<pavement::Params>(job.params);
  auto output = pavement::run(pictures.at("drawing"), params, job.seed, rasterizer, context, observer);
  if (!output) return tl::unexpected<Status>(std::move(output.error()));
  Outcome outcome{.sheet = {},
                  .counts = counts_of(*output),
                  .metrics = metrics_of(*output),
                  .plots = {{"vertices", vertices_plot(*output)}, {"areas", areas_plot(*output)}}};
  outcome.sheet = std::move(output->sheet);
  return outcome;
}

}  // namespace tessera
