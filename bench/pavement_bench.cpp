// The whole pavement of a wave, pixels to stones, on one thread; its growth with the picture's pixels.
#include <benchmark/benchmark.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "tessera/formats/formats.h"
#include "tessera/pavement/run.h"
#include "tessera/voronoi/cpu_rasterizer.h"

namespace tessera {
namespace {

cv::Mat3b wave(int size) {
  cv::Mat3b picture(size, size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double phase = 2 * (y + 0.06 * size * std::sin(6.28 * 3 * x / size)) / (0.25 * size);
      picture(y, x) = cv::Vec3b::all(static_cast<int>(std::floor(phase)) % 2 != 0 ? 0 : 255);
    }
  }
  return picture;
}

void pave(benchmark::State& state) {
  cv::setNumThreads(1);
  const cv::Mat3b picture = wave(static_cast<int>(state.range(0)));
  const ImageView view{picture.ptr(), picture.cols, picture.rows, static_cast<std::ptrdiff_t>(picture.step)};
  const auto rasterizer = make_cpu_rasterizer();
  for (auto _ : state) {
    const auto output = pavement::run(view, {}, 1, *rasterizer, {});
    benchmark::DoNotOptimize(write_svg(output->sheet));
    state.counters["stones"] = static_cast<double>(output->sheet.pieces.size());
  }
  state.SetComplexityN(state.range(0) * state.range(0));
}
BENCHMARK(pave)->RangeMultiplier(2)->Range(256, 2048)->Unit(benchmark::kMillisecond)->Complexity();

}  // namespace
}  // namespace tessera
