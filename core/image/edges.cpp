#include "tessera/image/edges.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace tessera {
namespace {

constexpr int kFiner = 16;  // levels are multiplied by this: smoothing leaves slopes of less than a level a pixel
constexpr int kFaintest = 16 * kFiner;  // Sobel units: two levels from pixel to pixel; fainter edges are noise
constexpr double kLowShare = 0.4;       // of the upper threshold: where edges that began above it may go on

struct Gradient {
  cv::Mat1s dx, dy;
};

// Of each pixel, Sobel's gradient of its channel with the longest one. Written out, since the library's differs
// between machines on these depths.
Gradient strongest_gradient(const cv::Mat3s& picture) {
  Gradient gradient{cv::Mat1s(picture.size()), cv::Mat1s(picture.size())};
  for (int y = 0; y < picture.rows; ++y) {
    const cv::Vec3s *above = picture[std::max(0, y - 1)], *row = picture[y],
                    *below = picture[std::min(picture.rows - 1, y + 1)];
    for (int x = 0; x < picture.cols; ++x) {
      const int left = std::max(0, x - 1), right = std::min(picture.cols - 1, x + 1);
      int longest = -1;
      for (int c = 0; c < 3; ++c) {
        const int dx =
            above[right][c] - above[left][c] + 2 * (row[right][c] - row[left][c]) + below[right][c] - below[left][c];
        const int dy =
            below[left][c] + 2 * below[x][c] + below[right][c] - above[left][c] - 2 * above[x][c] - above[right][c];
        const int size = dx * dx + dy * dy;
        if (size <= longest) continue;
        longest = size;
        gradient.dx(y, x) = static_cast<short>(dx);
        gradient.dy(y, x) = static_cast<short>(dy);
      }
    }
  }
  return gradient;
}

// The length that the given share of all gradients exceeds.
int length_of_share(const Gradient& gradient, double share) {
  std::vector<std::int64_t> histogram(std::size_t{1500} * kFiner, 0);  // 4 * 255 * sqrt(2) * kFiner at most
  for (int y = 0; y < gradient.dx.rows; ++y)
    for (int x = 0; x < gradient.dx.cols; ++x) {
      const int dx = gradient.dx(y, x), dy = gradient.dy(y, x);
      ++histogram[static_cast<int>(std::sqrt(static_cast<double>(dx * dx + dy * dy)))];
    }
  const double most = share * static_cast<double>(gradient.dx.total());
  std::int64_t longer = 0;
  int length = static_cast<int>(histogram.size()) - 1;
  while (length > 0 && static_cast<double>(longer + histogram[length]) <= most) longer += histogram[length--];
  return length;
}

void drop_short(cv::Mat1b& edges, double shortest) {
  cv::Mat1i labels;
  cv::Mat stats, centroids;
  cv::connectedComponentsWithStats(edges, labels, stats, centroids, 8, CV_32S);
  for (int y = 0; y < edges.rows; ++y)
    for (int x = 0; x < edges.cols; ++x)
      if (edges(y, x) != 0 && stats.at<int>(labels(y, x), cv::CC_STAT_AREA) < shortest) edges(y, x) = 0;
}

}  // namespace

cv::Mat1b find_edges(const cv::Mat3b& picture, const EdgeParams& params) {
  cv::Mat finer, smooth;
  picture.convertTo(finer, CV_16U, kFiner);
  if (params.sigma > 0) cv::GaussianBlur(finer, finer, {0, 0}, params.sigma, params.sigma, cv::BORDER_REPLICATE);
  finer.convertTo(smooth, CV_16S);
  const Gradient gradient = strongest_gradient(smooth);
  const int high = std::max(kFaintest, length_of_share(gradient, params.share));
  cv::Mat1b edges;
  cv::Canny(gradient.dx, gradient.dy, edges, kLowShare * high, high, true);
  drop_short(edges, params.shortest);
  return edges;
}

}  // namespace tessera
