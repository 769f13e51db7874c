// One Lloyd iteration at the paper's size, beside the time to write and read the label map once.
#include <benchmark/benchmark.h>

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

void iteration(benchmark::State& state) {
  cv::setNumThreads(1);
  const int size = static_cast<int>(state.range(0));
  Sites sites = grid_of_sites(size, size, 8);
  auto rasterizer = make_cpu_rasterizer();
  (void)rasterizer->begin(cv::Mat1b(size, size, static_cast<unsigned char>(0)), Metric::kFrustum, 64);
  LabelMap labels;
  for (auto _ : state) {
    (void)rasterizer->label(sites, labels);
    const auto moments = cell_moments(labels, static_cast<int>(sites.size()));
    for (std::size_t i = 0; i < sites.size(); ++i) {
      if (moments[i].count == 0) continue;
      sites[i].x = moments[i].centroid_x();
      sites[i].y = moments[i].centroid_y();
    }
  }
  state.counters["sites"] = static_cast<double>(sites.size());
}
BENCHMARK(iteration)->Arg(512)->Arg(1024)->Arg(2048)->Unit(benchmark::kMillisecond);

void write_and_read_label_map(benchmark::State& state) {
  const int size = static_cast<int>(state.range(0));
  LabelMap labels(size, size);
  int value = 0;
  for (auto _ : state) {
    labels.setTo(++value);
    benchmark::DoNotOptimize(cv::sum(labels));
  }
}
BENCHMARK(write_and_read_label_map)->Arg(1024)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tessera
