// A painted photo of pebbles.
#pragma once

#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

#include "tessera/base/portable_math.h"
#include "tessera/base/rng.h"

namespace tessera::pebbles {

struct Stone {
  double x, y, a, b, turn;  // px, half axes, radians
  bool holds(double px, double py) const {
    const SinCos t = sin_cos(turn);
    const double u = ((px - x) * t.cos + (py - y) * t.sin) / a, v = ((py - y) * t.cos - (px - x) * t.sin) / b;
    return u * u + v * v <= 1;
  }
};

struct Beach {
  cv::Mat3b photo;  // RGB
  std::vector<Stone> stones;
};

// `columns` x `rows` shaded, speckled, about equally light ellipses of half axes 9 to 20 px, 42 px apart, on dark sand.
inline Beach paint_beach(int columns, int rows, std::uint64_t seed) {
  constexpr int kApart = 42;
  Rng rng(seed, RngPurpose::kShapes);
  Beach beach{cv::Mat3b(rows * kApart, columns * kApart, cv::Vec3b(34, 30, 28)), {}};
  for (cv::Vec3b& ground : beach.photo) ground += cv::Vec3b::all(static_cast<std::uint8_t>(rng.bits() % 24));
  for (int k = 0; k < columns * rows; ++k) {
    const double a = rng.uniform(14, 20);
    const Stone stone{(k % columns + 0.5) * kApart + rng.uniform(-2, 2),
                      (k / columns + 0.5) * kApart + rng.uniform(-2, 2), a, a * rng.uniform(0.65, 1),
                      rng.uniform(0, kPi)};
    const double red = rng.uniform(160, 210), green = red - rng.uniform(0, 30), blue = green - rng.uniform(-20, 20);
    for (int y = static_cast<int>(stone.y - a) - 1; y <= stone.y + a + 1; ++y)
      for (int x = static_cast<int>(stone.x - a) - 1; x <= stone.x + a + 1; ++x) {
        if (!stone.holds(x + 0.5, y + 0.5)) continue;
        const double shade = 1 - 0.25 * (x - stone.x + y - stone.y) / (2 * a), speck = rng.uniform(-6, 6);
        const auto level = [&](double v) {
          return static_cast<std::uint8_t>(std::clamp(v * shade + speck, 0.0, 255.0));
        };
        beach.photo(y, x) = {level(red), level(green), level(blue)};
      }
    beach.stones.push_back(stone);
  }
  return beach;
}

}  // namespace tessera::pebbles
