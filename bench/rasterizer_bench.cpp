// One Lloyd iteration (label, centroids, move) on one thread, also as a multiple of writing and reading the label map.
#include <benchmark/benchmark.h>

#include <ctime>
#include <opencv2/core.hpp>

#include "tessera/base/rng.h"
#include "tessera/voronoi/cpu_rasterizer.h"
#include "tessera/voronoi/lloyd.h"

namespace tessera {
namespace {

Sites grid_of_sites(int width, int height, int side) {
  Rng rng(1, RngPurpose::kSites);
  Sites sites;
  for (int y = 0; y < height; y += side)
    for (int x = 0; x < width; x += side)
      sites.push_back({x + rng.uniform(0, side), y + rng.uniform(0, side), rng.uniform(0, 6.28),
                       static_cast<float>(0.25 * side * rng.uniform(0.5, 2)), 0.25f * static_cast<float>(side), 0});
  return sites;
}

// CPU seconds to write and read a label map once: what any iteration costs at least on this machine.
double write_and_read_seconds(int size) {
  constexpr int kRepeats = 50;
  LabelMap labels(size, size);
  const std::clock_t begin = std::clock();
  for (int i = 0; i < kRepeats; ++i) {
    labels.setTo(i);
    benchmark::DoNotOptimize(cv::sum(labels));
  }
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / kRepeats;
}

void iteration(benchmark::State& state) {
  cv::setNumThreads(1);
  const int size = static_cast<int>(state.range(0));
  Sites sites = grid_of_sites(size, size, 8);
  auto rasterizer = make_cpu_rasterizer();
  (void)rasterizer->begin(cv::Mat1b(size, size, static_cast<unsigned char>(0)), Metric::kFrustum, 64);
  LabelMap labels;
  CellSums sums;
  const std::clock_t begin = std::clock();
  for (auto _ : state) {
    (void)rasterizer->label(sites, labels);
    const auto& moments = sums.of(labels, static_cast<int>(sites.size()));
    for (std::size_t i = 0; i < sites.size(); ++i) {
      if (moments[i].count == 0) continue;
      sites[i].x = moments[i].centroid_x();
      sites[i].y = moments[i].centroid_y();
    }
  }
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  state.counters["sites"] = static_cast<double>(sites.size());
  state.counters["write_reads"] = seconds / static_cast<double>(state.iterations()) / write_and_read_seconds(size);
}
BENCHMARK(iteration)->Arg(512)->Arg(1024)->Arg(2048)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tessera
