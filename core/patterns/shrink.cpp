#include "tessera/patterns/shrink.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tessera::patterns {
namespace {

constexpr double kFoldedBack = 1e-9;  // 1 + cosine of a turn
constexpr double kBluntest = 0.3;     // the same of a hollow corner, whose tip would run far ahead else
constexpr double kNoLength = 1e-12;

std::size_t after(std::size_t i, const Ring& ring) { return i + 1 < ring.size() ? i + 1 : 0; }
std::size_t before(std::size_t i, const Ring& ring) { return i > 0 ? i - 1 : ring.size() - 1; }

// How far each corner moves where its sides move by one; false for a corner that has to go first.
bool speeds_of(Ring& ring, Ring& speeds) {
  speeds.clear();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point in = ring[i] - ring[before(i, ring)], out = ring[after(i, ring)] - ring[i];
    const double a = length(in), b = length(out);
    const double along = a > kNoLength && b > kNoLength ? 1 + dot(in, out) / (a * b) : 0;
    if (along < kFoldedBack) {
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
      return false;
    }
    const Point normals = Point{-in.y / a, in.x / a} + Point{-out.y / b, out.x / b};
    speeds.push_back((1 / (cross(in, out) < 0 ? std::max(along, kBluntest) : along)) * normals);
  }
  return true;
}

}  // namespace

Ring shrink(const Ring& whole, double distance) {
  Ring ring = whole, speeds;
  double left = distance;
  while (ring.size() >= 3) {
    if (!speeds_of(ring, speeds)) continue;
    double step = left;
    std::size_t vanishing = ring.size();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::size_t k = after(i, ring);
      const Point side = ring[k] - ring[i];
      const double closing = -dot(speeds[k] - speeds[i], side) / length(side);
      if (closing * step > length(side)) {
        step = length(side) / closing;
        vanishing = i;
      }
    }
    for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = ring[i] + step * speeds[i];
    if (vanishing == ring.size()) break;
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(vanishing));
    left -= step;
  }
  if (ring.size() < 3 || signed_area(ring) <= 0) return {};
  return is_simple(ring) ? ring : inset(whole, distance);
}

}  // namespace tessera::patterns
