#include "tessera/pebbles/strength.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace tessera::pebbles {
namespace {

constexpr int kFiner = 16;                // parts of a level that smoothing leaves
constexpr double kFine = 1, kCoarse = 3;  // px: sigmas of the two scales; the coarse one counts twice
constexpr int kGap = 25;                  // px: what is wider is no gap
constexpr double kSmoothing = 1.5;        // px: sigma of the strength itself; less makes more and smaller basins

cv::Mat blurred(const cv::Mat& picture, double sigma) {
  cv::Mat out;
  cv::GaussianBlur(picture, out, {0, 0}, sigma, sigma, cv::BORDER_REPLICATE);
  return out;
}

// Adds `weight` times the length of the central differences of all three channels.
void add_gradient(const cv::Mat3w& lab, float weight, cv::Mat1f& sum) {
  cv::parallel_for_({0, lab.rows}, [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) {
      const cv::Vec3w *above = lab[std::max(0, y - 1)], *row = lab[y], *below = lab[std::min(lab.rows - 1, y + 1)];
      float* out = sum[y];
      for (int x = 0; x < lab.cols; ++x) {
        const cv::Vec3w &left = row[std::max(0, x - 1)], &right = row[std::min(lab.cols - 1, x + 1)];
        std::int64_t squares = 0;
        for (int c = 0; c < 3; ++c) {
          const std::int64_t dx = right[c] - left[c], dy = below[x][c] - above[x][c];
          squares += dx * dx + dy * dy;
        }
        out[x] += weight * std::sqrt(static_cast<float>(squares));
      }
    }
  });
}

}  // namespace

cv::Mat1w border_strength(const cv::Mat3b& photo) {
  cv::Mat3b calm, lab;
  cv::medianBlur(photo, calm, 3);
  cv::cvtColor(calm, lab, cv::COLOR_RGB2Lab);
  cv::Mat finer;
  lab.convertTo(finer, CV_16U, kFiner);
  cv::Mat1f sum(photo.size(), 0.0f);
  add_gradient(blurred(finer, kFine), 0.5f, sum);
  add_gradient(blurred(finer, kCoarse), 1, sum);

  cv::Mat1b lightness, closed;
  cv::extractChannel(lab, lightness, 0);
  cv::morphologyEx(lightness, closed, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_RECT, {kGap, kGap}));
  cv::Mat1w strength(photo.size());
  for (int y = 0; y < sum.rows; ++y)
    for (int x = 0; x < sum.cols; ++x)
      strength(y, x) = static_cast<std::uint16_t>(
          std::min(65535.0f, sum(y, x) + static_cast<float>(kFiner * (closed(y, x) - lightness(y, x)))));
  return blurred(strength, kSmoothing);
}

}  // namespace tessera::pebbles
