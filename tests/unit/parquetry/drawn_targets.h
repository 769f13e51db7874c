// Targets with edges, and parameters of a grid that follows them.
#pragma once

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tessera/base/rng.h"
#include "tessera/parquetry/params.h"

namespace tessera::parquetry {

inline constexpr double kMm = 0.25;  // a pixel
inline constexpr int kCell = 48;     // px: 12 mm

inline Params morphed() {
  Params params;
  params.grid = GridKind::kMorphed;
  params.patch_mm = kCell * kMm;
  return params;
}

// Discs, bars and rings on a ground with noise.
inline cv::Mat3b shapes(Rng& rng, cv::Size size, int count) {
  cv::Mat3b picture(size, cv::Vec3b(200, 200, 200));
  const auto place = [&] {
    return cv::Point(static_cast<int>(rng.uniform(0, size.width)), static_cast<int>(rng.uniform(0, size.height)));
  };
  for (int i = 0; i < count; ++i) {
    const cv::Scalar colour = cv::Scalar::all(std::floor(rng.uniform(0, 255)));
    const auto extent = static_cast<int>(rng.uniform(10, 120));
    if (i % 3 == 0)
      cv::circle(picture, place(), extent, colour, cv::FILLED);
    else
      cv::line(picture, place(), place(), colour, i % 3 == 1 ? extent : 3);
  }
  for (cv::Vec3b& pixel : picture)
    pixel = cv::Vec3b::all(cv::saturate_cast<std::uint8_t>(pixel[0] + rng.uniform(-9, 9)));
  return picture;
}

}  // namespace tessera::parquetry
