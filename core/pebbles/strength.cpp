#include "tessera/pebbles/strength.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace tessera::pebbles {
namespace {

constexpr int kFiner = 16;          // parts of a level
constexpr double kFine = 1.2;       // px, sigma: finer than that is the surface of a pebble
constexpr double kCoarser = 2.6;    // px, sigma: on top of it, for the second scale, which counts twice
constexpr int kGap = 25;            // px: what is wider is no gap
constexpr double kSmoothing = 1.5;  // px, sigma: of the strength itself; less makes more and smaller basins

cv::Mat blurred(const cv::Mat& picture, double sigma) {
  cv::Mat out;
  cv::GaussianBlur(picture, out, {0, 0}, sigma, sigma, cv::BORDER_REFLECT_101);
  return out;
}

// Length of the central differences of all three channels.
float gradient(const cv::Vec3b& left, const cv::Vec3b& right, const cv::Vec3b& above, const cv::Vec3b& below) {
  int squares = 0;
  for (int c = 0; c < 3; ++c) {
    const int dx = right[c] - left[c], dy = below[c] - above[c];
    squares += dx * dx + dy * dy;
  }
  return std::sqrt(static_cast<float>(squares));
}

}  // namespace

cv::Mat1w border_strength(const cv::Mat3b& lab) {
  const cv::Mat3b fine = blurred(lab, kFine), coarse = blurred(fine, kCoarser);
  cv::Mat1b lightness, closed;
  cv::extractChannel(fine, lightness, 0);
  cv::morphologyEx(lightness, closed, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_RECT, {kGap, kGap}));
  cv::Mat1w strength(lab.size());
  cv::parallel_for_({0, lab.rows}, [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) {
      const int above = std::max(0, y - 1), below = std::min(lab.rows - 1, y + 1);
      for (int x = 0; x < lab.cols; ++x) {
        const int left = std::max(0, x - 1), right = std::min(lab.cols - 1, x + 1);
        const float edge = 0.5f * gradient(fine(y, left), fine(y, right), fine(above, x), fine(below, x)) +
                           gradient(coarse(y, left), coarse(y, right), coarse(above, x), coarse(below, x));
        strength(y, x) = static_cast<std::uint16_t>(static_cast<float>(kFiner) *
                                                    (edge + static_cast<float>(closed(y, x) - lightness(y, x))));
      }
    }
  });
  return blurred(strength, kSmoothing);
}

}  // namespace tessera::pebbles
