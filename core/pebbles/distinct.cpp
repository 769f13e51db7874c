#include "tessera/pebbles/distinct.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "tessera/base/portable_math.h"
#include "tessera/pebbles/neighbours.h"
#include "tessera/pebbles/region_tree.h"

namespace tessera::pebbles {
namespace {

constexpr double kLeastCut = 2;  // times the smallest diameter: what shows of a pebble that the picture's border cuts
constexpr int kAround = 3;       // px: width of what lies around a pebble
constexpr double kGrainSigma = 1.5;      // px: what is finer is grain
constexpr double kLeastSolid = 0.7;      // area against that of the convex hull
constexpr double kLeastSolidDark = 0.9;  // of what is darker than what is around: mostly a gap between pebbles
constexpr int kBeside = 2;               // px: from the border to where colours are compared across it
constexpr int kLeastChange = 10;         // levels, all channels together: less is none
constexpr double kMostOpen = 0.3;  // of its border: what is more open is a part of something larger, as the ground
constexpr int kFiner = 16;         // parts of a level

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
  std::int64_t grain = 0;    // sum of differences from the smoothed picture
  bool cut = false;          // by the picture's border
  int border = 0, open = 0;  // sides of pixels along the border; those across which nothing changes
  // Difference between the mean colours against the mean grain of the surface.
  bool darker_than_around() const { return inside.mean(0) < around.mean(0); }
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

// From the border between two pixels `step` apart, the pixels that follow are around the label before it, and the
// other way round.
void add_around(const cv::Mat3w& lab, const cv::Mat3w& smooth, const cv::Mat1i& labels, cv::Point after,
                cv::Point step, std::vector<Surface>& surfaces) {
  const cv::Rect all({0, 0}, labels.size());
  const cv::Point here = after - (1 + kBeside) * step, there = after + kBeside * step;
  const bool changes = all.contains(here) && all.contains(there) &&
                       sum_of_differences(smooth(here), smooth(there)) >= kLeastChange * kFiner;
  for (const cv::Point side : {after - step, after}) {
    ++surfaces[labels(side)].border;
    surfaces[labels(side)].open += changes ? 0 : 1;
  }
  const auto add = [&](int label, cv::Point pixel, cv::Point onwards) {
    for (int d = 0; label != 0 && d < kAround && all.contains(pixel); ++d, pixel += onwards)
      if (labels(pixel) != label) surfaces[label].around.add(lab(pixel));
  };
  add(labels(after - step), after, step);
  add(labels(after), after - step, -step);
}

std::vector<Surface> surfaces_of(const cv::Mat3b& lab, const cv::Mat1i& labels) {
  cv::Mat3w finer, smooth;
  lab.convertTo(finer, CV_16U, kFiner);
  cv::GaussianBlur(finer, smooth, {0, 0}, kGrainSigma, kGrainSigma, cv::BORDER_REPLICATE);
  std::vector<Surface> surfaces(largest_label(labels) + 1);
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) {
      Surface& own = surfaces[labels(y, x)];
      own.inside.add(finer(y, x));
      own.cut |= x == 0 || y == 0 || x + 1 == labels.cols || y + 1 == labels.rows;
      own.grain += sum_of_differences(finer(y, x), smooth(y, x));
      if (x > 0 && labels(y, x) != labels(y, x - 1)) add_around(finer, smooth, labels, {x, y}, {1, 0}, surfaces);
      if (y > 0 && labels(y, x) != labels(y - 1, x)) add_around(finer, smooth, labels, {x, y}, {0, 1}, surfaces);
    }
  return surfaces;
}

}  // namespace

void drop_indistinct(const cv::Mat3b& lab, const Params& params, cv::Mat1i& labels) {
  const std::vector<Surface> surfaces = surfaces_of(lab, labels);
  const std::vector<double> hulls = hull_areas(labels, static_cast<int>(surfaces.size()));
  std::vector<int> number(surfaces.size(), 0);
  for (std::size_t label = 1; label < surfaces.size(); ++label) {
    const double area = static_cast<double>(surfaces[label].inside.count);
    const double solidity = area / hulls[label];
    const bool is_gap = surfaces[label].darker_than_around() && solidity < kLeastSolidDark;
    const double smallest = surfaces[label].cut ? kLeastCut * params.smallest : params.smallest;
    if (4 * area >= kPi * smallest * smallest && solidity >= kLeastSolid && !is_gap &&
        surfaces[label].open <= kMostOpen * surfaces[label].border &&
        surfaces[label].distinctness() >= params.contrast)
      number[label] = static_cast<int>(label);
  }
  for (int& label : labels) label = number[label];
}

}  // namespace tessera::pebbles
