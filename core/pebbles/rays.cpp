#include "tessera/pebbles/rays.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tessera/base/portable_math.h"
#include "tessera/pebbles/neighbours.h"

namespace tessera::pebbles {
namespace {

constexpr int kFractionBits = 16;

// A way of single steps along x or y.
struct Way {
  int dx, dy;                  // 1 or -1
  std::int64_t share_along_x;  // of the steps, in parts of 2^kFractionBits

  cv::Point after(int steps) const {
    const std::int64_t half = 1 << (kFractionBits - 1);
    const auto along_x = static_cast<int>((steps * share_along_x + half) >> kFractionBits);
    return {dx * along_x, dy * (steps - along_x)};
  }
};

const std::array<Way, kRays>& ways() {
  static const auto all = [] {
    std::array<Way, kRays> out{};
    for (int k = 0; k < kRays; ++k) {
      const SinCos turn = sin_cos(2 * kPi * k / kRays);
      const double along = std::fabs(turn.cos), across = std::fabs(turn.sin);
      out[k] = {turn.cos < 0 ? -1 : 1, turn.sin < 0 ? -1 : 1,
                static_cast<std::int64_t>(std::floor((1 << kFractionBits) * along / (along + across) + 0.5))};
    }
    return out;
  }();
  return all;
}

}  // namespace

Mask::Mask(const cv::Mat1b& edges)
    : width_(edges.cols), height_(edges.rows), distance_(edges.rows + 2, edges.cols + 2, 0) {
  for (int y = 1; y <= height_; ++y)
    for (int x = 1; x <= width_; ++x)
      if (edges(y - 1, x - 1) == 0) distance_(y, x) = 1 + std::min(distance_(y - 1, x), distance_(y, x - 1));
  for (int y = height_; y >= 1; --y)
    for (int x = width_; x >= 1; --x)
      distance_(y, x) = std::min(distance_(y, x), 1 + std::min(distance_(y + 1, x), distance_(y, x + 1)));
}

// As many steps at once as there are free pixels around.
std::array<cv::Point, kRays> Mask::hits(cv::Point from) const {
  std::array<cv::Point, kRays> found{};
  for (int k = 0; k < kRays; ++k) {
    found[k] = from;
    int steps = 0;
    for (int free = distance(from); free > 0; free = distance(found[k])) {
      steps += free;
      found[k] = from + ways()[k].after(steps);
    }
  }
  return found;
}

void Mask::fill(const std::vector<cv::Point>& pixels) {
  std::vector<cv::Point> open = pixels;
  for (const cv::Point p : pixels) distance_(p.y + 1, p.x + 1) = 0;
  for (std::size_t k = 0; k < open.size(); ++k) {
    const int x = open[k].x + 1, y = open[k].y + 1, farther = distance_(y, x) + 1;
    each_neighbour(distance_, y, x, [&](int v, int u) {
      if (distance_(v, u) <= farther) return;
      distance_(v, u) = farther;
      open.emplace_back(u - 1, v - 1);
    });
  }
}

}  // namespace tessera::pebbles
