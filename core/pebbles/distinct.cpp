#include "tessera/pebbles/distinct.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "tessera/base/portable_math.h"

namespace tessera::pebbles {
namespace {

constexpr int kAround = 3;           // px: width of what lies around a pebble
constexpr double kGrainSigma = 1.5;  // px: what is finer is grain
constexpr int kFiner = 16;           // parts of a level

// Sums over pixels of Lab, in parts of a level.
struct Tone {
  std::int64_t count = 0;
  cv::Vec<std::int64_t, 3> sum{0, 0, 0};
  void add(const cv::Vec3w& lab) {
    ++count;
    for (int c = 0; c < 3; ++c) sum[c] += lab[c];
  }
  double mean(int c) const {
    return static_cast<double>(sum[c]) / static_cast<double>(std::max<std::int64_t>(1, count));
  }
};

struct Surface {
  Tone inside, around;
  std::int64_t grain = 0;  // sum of differences from the smoothed picture
  // Difference between the mean colours against the mean grain of the surface.
  double distinctness() const {
    double contrast = 0;
    for (int c = 0; c < 3; ++c) contrast += std::fabs(inside.mean(c) - around.mean(c));
    return around.count == 0
               ? 0
               : contrast * static_cast<double>(inside.count) / static_cast<double>(std::max<std::int64_t>(1, grain));
  }
};

int sum_of_differences(const cv::Vec3w& a, const cv::Vec3w& b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

// A pixel counts as around each label that it is not of and that is within kAround pixels along its row or column.
void add_around(const cv::Mat3w& lab, const cv::Mat1i& labels, int y, int x, std::vector<Surface>& surfaces) {
  int seen[4] = {labels(y, x), 0, 0, 0};
  int known = 1;
  for (const auto& [dy, dx] : {std::pair{0, 1}, {0, -1}, {1, 0}, {-1, 0}})
    for (int d = 1; d <= kAround; ++d) {
      const int v = y + d * dy, u = x + d * dx;
      if (v < 0 || u < 0 || v >= labels.rows || u >= labels.cols) break;
      const int label = labels(v, u);
      if (label == 0 || std::find(seen, seen + known, label) != seen + known) continue;
      if (known < 4) seen[known++] = label;
      surfaces[label].around.add(lab(y, x));
    }
}

std::vector<Surface> surfaces_of(const cv::Mat3b& photo, const cv::Mat1i& labels) {
  int count = 0;
  for (const int label : labels) count = std::max(count, label);
  cv::Mat3b lab;
  cv::cvtColor(photo, lab, cv::COLOR_RGB2Lab);
  cv::Mat3w finer, smooth;
  lab.convertTo(finer, CV_16U, kFiner);
  cv::GaussianBlur(finer, smooth, {0, 0}, kGrainSigma, kGrainSigma, cv::BORDER_REPLICATE);
  std::vector<Surface> surfaces(count + 1);
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) {
      Surface& own = surfaces[labels(y, x)];
      own.inside.add(finer(y, x));
      own.grain += sum_of_differences(finer(y, x), smooth(y, x));
      add_around(finer, labels, y, x, surfaces);
    }
  return surfaces;
}

}  // namespace

void drop_indistinct(const cv::Mat3b& photo, const Params& params, cv::Mat1i& labels) {
  const std::vector<Surface> surfaces = surfaces_of(photo, labels);
  std::vector<int> number(surfaces.size(), 0);
  for (std::size_t label = 1; label < surfaces.size(); ++label) {
    const double area = static_cast<double>(surfaces[label].inside.count);
    if (4 * area >= kPi * params.smallest * params.smallest && surfaces[label].distinctness() >= params.contrast)
      number[label] = static_cast<int>(label);
  }
  for (int& label : labels) label = number[label];
}

}  // namespace tessera::pebbles
