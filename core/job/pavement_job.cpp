#include "tessera/job/pavement_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tessera/job/guarded.h"
#include "tessera/job/job_json.h"
#include "tessera/job/parameters.h"
#include "tessera/job/statistics.h"
#include "tessera/job/tile_by_tile.h"
#include "tessera/pavement/run.h"
#include "tessera/pavement/tiles.h"

namespace tessera {
namespace {

constexpr int kAreaBins = 30;

// What the report says of stones, as they come.
class Tally {
 public:
  void add(const pavement::Output& part) {
    for (const int vertices : part.vertices_after) ++with_vertices_[vertices];
    for (const double area : part.areas) {
      ++stones_;
      sum_ += area;
      sum_of_squares_ += area * area;
    }
  }

  std::map<std::string, std::int64_t> counts(int sites, int reseeded) const {
    std::map<std::string, std::int64_t> counts = {{"stones", stones_}, {"sites", sites}, {"reseeded", reseeded}};
    for (const auto& [vertices, stones] : with_vertices_)
      counts[fmt::format("stones_with_{}_vertices", vertices)] = stones;
    return counts;
  }

  std::map<std::string, double> metrics() const {
    if (stones_ == 0) return {};
    const double n = static_cast<double>(stones_), mean = sum_ / n;
    const auto quads = with_vertices_.find(4);
    return {{"area_mean", mean},
            {"area_cv", std::sqrt(std::max(0.0, sum_of_squares_ / n - mean * mean)) / mean},
            {"quad_fraction", quads == with_vertices_.end() ? 0 : static_cast<double>(quads->second) / n}};
  }

 private:
  std::int64_t stones_ = 0;
  std::map<int, std::int64_t> with_vertices_;
  double sum_ = 0, sum_of_squares_ = 0;
};

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

void append(pavement::Output& all, pavement::Output part) {
  const auto move = [](auto& to, auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  move(all.vertices_before, part.vertices_before);
  move(all.vertices_after, part.vertices_after);
  move(all.areas, part.areas);
  if (all.sheet.pieces.empty()) {
    all.sheet = std::move(part.sheet);
  } else {
    move(all.sheet.pieces, part.sheet.pieces);
  }
}

Result<pavement::Output> run_in_tiles(const Job& job, const ImageView& drawing, Rasterizer& rasterizer,
                                      const RunContext& context) {
  RowsOfView rows(drawing);
  pavement::Output all;
  const auto done = pavement::run_tiles(rows, std::get<pavement::Params>(job.params), job.seed, rasterizer, context,
                                        [&](pavement::Output part) -> Result<void> {
                                          append(all, std::move(part));
                                          return {};
                                        });
  if (!done) return tl::unexpected(done.error());
  all.sites = done->sites;
  all.reseeded = done->reseeded;
  return all;
}

}  // namespace

Result<Outcome> run_pavement_job(const Job& job, const Pictures& pictures, Rasterizer& rasterizer,
                                 const RunContext& context, const IterationObserver& observer) {
  const auto& params = std::get<pavement::Params>(job.params);
  const ImageView& drawing = pictures.at("drawing");
  auto output = params.tiles > 0 ? run_in_tiles(job, drawing, rasterizer, context)
                                 : pavement::run(drawing, params, job.seed, rasterizer, context, observer);
  if (!output) return tl::unexpected<Status>(std::move(output.error()));
  Tally tally;
  tally.add(*output);
  Outcome outcome{.sheet = {},
                  .counts = tally.counts(output->sites, output->reseeded),
                  .metrics = tally.metrics(),
                  .plots = {{"vertices", vertices_plot(*output)}, {"areas", areas_plot(*output)}}};
  outcome.sheet = std::move(output->sheet);
  return outcome;
}

bool goes_tile_by_tile(const Job& job) {
  const auto* params = std::get_if<pavement::Params>(&job.params);
  return params && params->tiles > 0;
}

tl::expected<JobResult, Problems> run_tile_by_tile(const Job& job, RowSource& drawing, Rasterizer& rasterizer,
                                                   const RunContext& context, const TakeBytes& svg) {
  Problems problems;
  check_params(job.params, problems);
  if (!problems.empty()) return tl::unexpected<Problems>(std::move(problems));
  return guarded([&]() -> Result<JobResult> {
    Tally tally;
    bool begun = false;
    const auto take = [&](pavement::Output part) -> Result<void> {
      tally.add(part);
      std::string bytes;
      if (!std::exchange(begun, true)) {
        part.sheet.job_json = job_to_text(job);
        bytes = svg_head(part.sheet);
      }
      append_svg_pieces(bytes, part.sheet);
      return svg(bytes);
    };
    const auto done =
        pavement::run_tiles(drawing, std::get<pavement::Params>(job.params), job.seed, rasterizer, context, take);
    if (!done) return tl::unexpected(done.error());
    if (auto written = svg(svg_foot()); !written) return tl::unexpected(written.error());
    return JobResult{{}, tally.counts(done->sites, done->reseeded), tally.metrics(), job};
  });
}

}  // namespace tessera
