// Pebbles for tests.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "tessera/base/portable_math.h"
#include "tessera/base/rng.h"
#include "tessera/geometry/mesh.h"
#include "tessera/pebbles/pebble.h"

namespace tessera::pebbles {

// The radii of an ellipse with semi-axes a (along x) and b.
inline std::vector<double> ellipse(double a, double b, int count) {
  std::vector<double> radii;
  for (int k = 0; k < count; ++k) {
    const SinCos phi = sin_cos(2 * kPi * k / count);
    radii.push_back(a * b / std::sqrt(b * b * phi.cos * phi.cos + a * a * phi.sin * phi.sin));
  }
  return radii;
}

// Star-shaped and rough: each radius anything from `least` to 1, times `size`.
inline std::vector<double> rough(std::uint64_t seed, double size, double least, int count) {
  Rng rng(seed, RngPurpose::kShapes);
  std::vector<double> radii;
  for (int k = 0; k < count; ++k) radii.push_back(size * rng.uniform(least, 1));
  return radii;
}

// Every edge borders two triangles, which pass it in opposite directions.
inline bool is_closed(const std::vector<std::uint32_t>& indices) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> times;
  for (std::size_t t = 0; t + 2 < indices.size(); t += 3)
    for (std::size_t k = 0; k < 3; ++k) ++times[{indices[t + k], indices[t + (k + 1) % 3]}];
  for (const auto& [edge, count] : times) {
    const auto back = times.find({edge.second, edge.first});
    if (edge.first == edge.second || count != 1 || back == times.end()) return false;
  }
  return !times.empty();
}

}  // namespace tessera::pebbles
