// Pixels to stones, and stones to bytes, on one thread; growth with the size of the beach.
#include <benchmark/benchmark.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "tessera/base/rng.h"
#include "tessera/formats/formats.h"
#include "tessera/pebbles/run.h"

namespace tessera {
namespace {

// Shaded ellipses of several greys and browns on dark ground, some 28 px apart.
cv::Mat3b beach(int width, int height) {
  constexpr int kApart = 28;
  cv::Mat3b picture(height, width, cv::Vec3b(18, 16, 20));
  Rng rng(1, RngPurpose::kShapes);
  for (int j = 0; j * kApart < height; ++j)
    for (int i = 0; i * kApart < width; ++i) {
      const double cx = (i + 0.5 + 0.2 * (rng.uniform() - 0.5)) * kApart;
      const double cy = (j + 0.5 + 0.2 * (rng.uniform() - 0.5)) * kApart;
      const double a = kApart * (0.36 + 0.12 * rng.uniform()), b = a * (0.6 + 0.35 * rng.uniform());
      const double turn = 3.14 * rng.uniform(), grey = 90 + 120 * rng.uniform(), brown = 40 * rng.uniform();
      for (int y = std::max(0, static_cast<int>(cy - a)); y < std::min<double>(height, cy + a); ++y)
        for (int x = std::max(0, static_cast<int>(cx - a)); x < std::min<double>(width, cx + a); ++x) {
          const double dx = x - cx, dy = y - cy;
          const double u = (dx * std::cos(turn) + dy * std::sin(turn)) / a,
                       v = (dy * std::cos(turn) - dx * std::sin(turn)) / b, r = u * u + v * v;
          if (r < 1)
            picture(y, x) = cv::Vec3b(cv::Vec3d(grey, grey - brown / 2, grey - brown) * (1 - 0.4 * r) +
                                      cv::Vec3d::all(8 * rng.uniform()));
        }
    }
  return picture;
}

ImageView view_of(const cv::Mat3b& picture) {
  return {picture.ptr(), picture.cols, picture.rows, static_cast<std::ptrdiff_t>(picture.step)};
}

void find_pebbles(benchmark::State& state) {
  cv::setNumThreads(1);
  const int width = static_cast<int>(state.range(0));
  const cv::Mat3b picture = beach(width, width * 3 / 4);
  pebbles::Params params;
  params.width = width;
  for (auto _ : state) {
    const auto output = pebbles::run({view_of(picture), {}}, params, 1, {});
    state.counters["pebbles"] = static_cast<double>(output->pebbles.size());
  }
}
BENCHMARK(find_pebbles)->Arg(450)->Arg(900)->Arg(1800)->Arg(3600)->Unit(benchmark::kMillisecond);

void write_pebbles(benchmark::State& state) {
  cv::setNumThreads(1);
  const cv::Mat3b picture = beach(900, 675);
  const auto output = pebbles::run({view_of(picture), {}}, {}, 1, {});
  for (auto _ : state) benchmark::DoNotOptimize(write_glb(output->scene));
}
BENCHMARK(write_pebbles)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tessera
