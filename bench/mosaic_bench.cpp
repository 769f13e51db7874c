// The whole mosaic of a picture of 900 x 900, pixels to SVG, on one thread; its growth with the number of tiles.
#include <benchmark/benchmark.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "tessera/formats/formats.h"
#include "tessera/mosaic/run.h"
#include "tessera/voronoi/cpu_rasterizer.h"

namespace tessera {
namespace {

// Discs of several colours before a sky that gets lighter downwards, with a fine texture in a part of it.
cv::Mat3b still_life(int size) {
  cv::Mat3b picture(size, size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double u = static_cast<double>(x) / size, v = static_cast<double>(y) / size;
      cv::Vec3d colour(120 + 80 * v, 140 + 60 * v, 200);
      if (u > 0.6 && v > 0.6) colour += cv::Vec3d::all(30 * std::sin(150 * u) * std::sin(170 * v));
      for (int k = 0; k < 5; ++k) {
        const double r = std::hypot(u - 0.15 - 0.17 * k, v - 0.3 - 0.1 * (k % 3));
        if (r < 0.11) colour = cv::Vec3d(200 - 30 * k, 60 + 30 * k, 40 + 20 * k) * (1 - 3 * r);
      }
      picture(y, x) = cv::Vec3b(colour);
    }
  }
  return picture;
}

void lay_mosaic(benchmark::State& state) {
  cv::setNumThreads(1);
  const cv::Mat3b picture = still_life(900);
  const ImageView photo{picture.ptr(), picture.cols, picture.rows, static_cast<std::ptrdiff_t>(picture.step)};
  const auto rasterizer = make_cpu_rasterizer();
  mosaic::Params params;
  params.tiles = static_cast<int>(state.range(0));
  for (auto _ : state) {
    const auto output = mosaic::run({photo, {}, {}, {}}, params, 1, *rasterizer, {});
    benchmark::DoNotOptimize(write_svg(output->sheet));
    state.counters["tiles"] = static_cast<double>(output->sheet.pieces.size());
  }
}
BENCHMARK(lay_mosaic)->Arg(1000)->Arg(10000)->Arg(40000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tessera
