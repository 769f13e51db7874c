// Patterns from a process to their files' bytes, on one thread: growth with the number of cells.
#include <benchmark/benchmark.h>

#include <cmath>

#include "tessera/formats/formats.h"
#include "tessera/patterns/run.h"
#include "tessera/points/processes.h"
#include "tessera/statistics/points.h"

namespace tessera {
namespace {

using patterns::Model;

patterns::Params params_of(Model model, double cells) {
  patterns::Params params;
  params.model = model;
  params.size = 8;
  params.width = params.height = 8 * std::sqrt(cells);
  return params;
}

void tessellate(benchmark::State& state, Model model) {
  const patterns::Params params = params_of(model, static_cast<double>(state.range(0)));
  for (auto _ : state) {
    const auto output = patterns::run({}, params, 1, {});
    benchmark::DoNotOptimize(write_geojson(output->sheet));
    state.counters["cells"] = static_cast<double>(output->sheet.pieces.size());
  }
  state.SetComplexityN(state.range(0));
}
void cells_of(benchmark::internal::Benchmark* b) {
  b->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond)->Complexity(benchmark::oNLogN);
}
BENCHMARK_CAPTURE(tessellate, occupancy, Model::kOccupancy)->Apply(cells_of)->Arg(1000000);
BENCHMARK_CAPTURE(tessellate, delaunay, Model::kDelaunay)->Apply(cells_of);
BENCHMARK_CAPTURE(tessellate, poisson_lines, Model::kPoissonLines)->Apply(cells_of);
BENCHMARK_CAPTURE(tessellate, johnson_mehl, Model::kJohnsonMehl)->Apply(cells_of);
BENCHMARK_CAPTURE(tessellate, hexagon, Model::kHexagon)->Apply(cells_of);

// Circles to the pixels of a PNG of 8192 x 8192.
void bomb(benchmark::State& state) {
  patterns::Params params = params_of(Model::kCircles, static_cast<double>(state.range(0)));
  params.length = 8;
  for (auto _ : state) {
    auto output = patterns::run({}, params, 1, {});
    benchmark::DoNotOptimize(write_png(output->sheet, 8192 / params.width));
  }
}
BENCHMARK(bomb)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond);

void ripley(benchmark::State& state) {
  Rng rng(1, RngPurpose::kSites);
  const double side = std::sqrt(static_cast<double>(state.range(0)));
  const Window window{{0, 0}, {side, side}};
  const auto points = poisson_points(window, 1, rng);
  std::vector<double> radii;
  for (int k = 1; k <= 24; ++k) radii.push_back(4.0 * k / 24);
  for (auto _ : state) benchmark::DoNotOptimize(statistics::point_statistics(points, window, radii));
  state.SetComplexityN(state.range(0));
}
BENCHMARK(ripley)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond)->Complexity(benchmark::oN);

}  // namespace
}  // namespace tessera
