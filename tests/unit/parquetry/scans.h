// Scans of wood, made in code.
#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "tessera/base/distributions.h"
#include "tessera/base/portable_math.h"
#include "tessera/base/rng.h"

namespace tessera::parquetry {

inline std::uint8_t level_of(double value) { return static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0)); }

// Grain along x: streaks that wander, some dark, and pores.
inline void paint_wood(cv::Mat3b& scan, cv::Rect where, cv::Vec3b colour, std::uint64_t seed) {
  Rng rng(seed, RngPurpose::kNoise);
  std::vector<double> streak(static_cast<std::size_t>(scan.rows) + 64);
  double drift = 0;
  for (double& s : streak) s = drift = 0.8 * drift + 9 * draw_normal(rng);
  for (int y = where.y; y < where.br().y; ++y)
    for (int x = where.x; x < where.br().x; ++x) {
      const double wave = 3 * sin_cos(x * 0.02 + static_cast<double>(seed)).sin;
      const double shade = streak[static_cast<std::size_t>(y + 8 + wave)] + 3 * draw_normal(rng);
      for (int c = 0; c < 3; ++c) scan(y, x)[c] = level_of(colour[c] + shade);
    }
}

inline void paint_disc(cv::Mat3b& scan, double x, double y, double radius, cv::Vec3b colour) {
  for (int v = 0; v < scan.rows; ++v)
    for (int u = 0; u < scan.cols; ++u) {
      const double inside = std::clamp(radius + 0.5 - std::hypot(u + 0.5 - x, v + 0.5 - y), 0.0, 1.0);
      for (int c = 0; c < 3; ++c) scan(v, u)[c] = level_of(scan(v, u)[c] + inside * (colour[c] - scan(v, u)[c]));
    }
}

inline void add_noise(cv::Mat3b& scan, double deviation, std::uint64_t seed) {
  Rng rng(seed, RngPurpose::kPixels);
  for (cv::Vec3b& p : scan)
    for (int c = 0; c < 3; ++c) p[c] = level_of(p[c] + deviation * draw_normal(rng));
}

}  // namespace tessera::parquetry
