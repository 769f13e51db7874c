// Small drawings made in code, kind ones and hostile ones, for the tests of the pavement.
#pragma once

#include <cmath>
#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "../image_views.h"
#include "tessera/base/rng.h"

namespace tessera {

inline cv::Vec3b grey(int value) { return cv::Vec3b::all(static_cast<unsigned char>(value)); }

// Black where inside(x, y), anti-aliased by 4 x 4 samples a pixel.
inline cv::Mat3b draw(int width, int height, const std::function<bool(double, double)>& inside) {
  cv::Mat3b picture(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      int hits = 0;
      for (int k = 0; k < 16; ++k) hits += inside(x + (k % 4 + 0.5) / 4, y + (k / 4 + 0.5) / 4);
      picture(y, x) = grey(255 - hits * 255 / 16);
    }
  }
  return picture;
}

inline cv::Mat3b disc_drawing(int side = 72) {
  return draw(side, side,
              [=](double x, double y) { return std::hypot(x - 0.52 * side, y - 0.47 * side) < 0.31 * side; });
}

inline cv::Mat3b wave_drawing(int width = 96, int height = 64) {
  return draw(width, height, [](double x, double y) { return std::fmod(y + 6 * std::sin(x / 9) + 40, 32) < 16; });
}

inline cv::Mat3b checker_drawing(int width, int height, int side) {
  cv::Mat3b picture(height, width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) picture(y, x) = grey((x / side + y / side) % 2 * 255);
  return picture;
}

inline cv::Mat3b noise_drawing(int width, int height) {
  Rng rng(5, RngPurpose::kNoise);
  cv::Mat3b picture(height, width);
  for (cv::Vec3b& v : picture) v = grey(static_cast<int>(rng.bits() & 255));
  return picture;
}

inline cv::Mat3b flat_drawing(int width, int height, int value) { return cv::Mat3b(height, width, grey(value)); }

inline cv::Mat3b four_colour_drawing() {
  cv::Mat3b picture(60, 80, cv::Vec3b(230, 220, 40));
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      if (x > 38 && y < 33) picture(y, x) = {30, 60, 160};
      if (std::hypot(x - 24, y - 40) < 13) picture(y, x) = {200, 30, 30};
      if (std::fabs(x - y - 22) < 4) picture(y, x) = {20, 20, 20};
    }
  }
  return picture;
}

inline cv::Mat3b single_pixel_drawing() {
  cv::Mat3b picture = flat_drawing(30, 30, 255);
  picture(14, 17) = grey(0);
  return picture;
}

inline cv::Mat3b hairline_cross_drawing() {
  cv::Mat3b picture = flat_drawing(60, 48, 255);
  picture.col(30).setTo(cv::Scalar::all(0));
  picture.row(21).setTo(cv::Scalar::all(0));
  return picture;
}

struct NamedDrawing {
  std::string name;
  cv::Mat3b picture;
  int colors = 2;
};

inline std::vector<NamedDrawing> all_drawings() {
  return {{"disc", disc_drawing()},
          {"wave", wave_drawing()},
          {"checker of one pixel", checker_drawing(40, 32, 1)},
          {"checker of five pixels", checker_drawing(50, 40, 5)},
          {"noise", noise_drawing(48, 40)},
          {"single pixel", single_pixel_drawing()},
          {"all black", flat_drawing(50, 40, 0)},
          {"all white", flat_drawing(50, 40, 255)},
          {"1x1", flat_drawing(1, 1, 0)},
          {"3x200", draw(3, 200, [](double, double y) { return std::fmod(y, 50) < 20; })},
          {"hairline cross", hairline_cross_drawing()},
          {"four colours", four_colour_drawing(), 4}};
}

}  // namespace tessera
