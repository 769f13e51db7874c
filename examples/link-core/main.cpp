// Paves a drawing that is made on the spot, a black disc on white, and prints the stones as SVG:
//
//   link_core >disc.svg
#include <cstdint>
#include <iostream>
#include <vector>

#include "tessera/job/job.h"
#include "tessera/voronoi/cpu_rasterizer.h"

namespace {

// 8-bit RGB, rows from the top, without gaps.
std::vector<std::uint8_t> disc(int size) {
  std::vector<std::uint8_t> pixels;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const int dx = 2 * x + 1 - size, dy = 2 * y + 1 - size;  // from the middle, in half pixels
      pixels.insert(pixels.end(), 3, 4 * (dx * dx + dy * dy) < size * size ? 0 : 255);
    }
  }
  return pixels;
}

}  // namespace

int main() {
  constexpr int kSize = 160;
  const std::vector<std::uint8_t> pixels = disc(kSize);
  const tessera::ImageView drawing{pixels.data(), kSize, kSize, 3 * kSize};

  tessera::Job job;
  job.params = tessera::pavement::Params{.half_side = 5};
  const auto rasterizer = tessera::make_cpu_rasterizer();
  const auto result = tessera::run_job(job, {{"drawing", drawing}}, {.formats = {"svg"}}, *rasterizer, {});
  if (!result) {
    for (const tessera::Status& problem : result.error())
      std::cerr << problem.field << ": " << problem.message << '\n';
    return 1;
  }
  std::cout << result->artifacts.front().bytes;
}
