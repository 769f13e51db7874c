// Small photos made in code, kind ones and hostile ones, for the tests of mosaics.
#pragma once

#include <cmath>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "../image_views.h"
#include "tessera/base/rng.h"

namespace tessera::mosaic {

struct Photo {
  std::string name;
  cv::Mat3b picture;
};

template <class Colour>
cv::Mat3b paint(int width, int height, const Colour& colour) {
  cv::Mat3b picture(height, width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) picture(y, x) = colour(x + 0.5, y + 0.5);
  return picture;
}

inline cv::Mat3b plain_photo(int width = 120, int height = 90) {
  return paint(width, height, [](double, double) { return cv::Vec3b(180, 160, 140); });
}

// A red disc before a grey wall that gets lighter to the right.
inline cv::Mat3b disc_photo(int side = 160) {
  return paint(side, side, [=](double x, double y) {
    const int wall = static_cast<int>(120 + 100 * x / side);
    return std::hypot(x - 0.5 * side, y - 0.5 * side) < 0.3 * side ? cv::Vec3b(190, 40, 40)
                                                                   : cv::Vec3b(wall, wall, wall);
  });
}

inline cv::Mat3b noise_photo(int width = 90, int height = 70) {
  Rng rng(7, RngPurpose::kNoise);
  return paint(width, height,
               [&](double, double) { return cv::Vec3b(rng.bits() & 255, rng.bits() & 255, rng.bits() & 255); });
}

inline cv::Mat3b checker_photo(int width = 80, int height = 64) {
  return paint(width, height, [](double x, double y) {
    return (static_cast<int>(x) + static_cast<int>(y)) % 2 == 0 ? cv::Vec3b(0, 0, 0) : cv::Vec3b(255, 255, 255);
  });
}

inline std::vector<Photo> all_photos() {
  return {{"disc", disc_photo()},
          {"plain", plain_photo()},
          {"noise", noise_photo()},
          {"checker", checker_photo()},
          {"one pixel", plain_photo(1, 1)},
          {"a line of pixels", noise_photo(70, 1)},
          {"a column of pixels", noise_photo(1, 50)}};
}

}  // namespace tessera::mosaic
