#include "tessera/geometry/narrow.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "tessera/geometry/scan.h"

namespace tessera {
namespace {

// The polygon's pixels, with one around them that is none of its.
class Pixels {
 public:
  Pixels(const Polygon& polygon, double side) : side_(side) {
    const Bounds box = bounds_of(polygon.outer);
    low_ = box.low;
    const auto count = [&](double length) { return static_cast<int>(std::ceil(length / side)) + 2; };
    mask_ = cv::Mat1b(count(box.high.y - low_.y), count(box.high.x - low_.x), static_cast<std::uint8_t>(0));
    Polygon scaled = polygon;
    const auto scale = [&](Ring& ring) {
      for (Point& p : ring) p = 1 / side * (p - low_) + Point{1, 1};
    };
    scale(scaled.outer);
    for (Ring& hole : scaled.holes) scale(hole);
    each_run(scaled, mask_.cols, mask_.rows,
             [&](int y, int begin, int end) { mask_.row(y).colRange(begin, end).setTo(1); });
    cv::distanceTransform(mask_, depth_, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    depth_ -= 0.5F;  // the side is half way to the next pixel that is outside
  }

  const cv::Mat1b& mask() const { return mask_; }
  const cv::Mat1f& depth() const { return depth_; }
  Point at(cv::Point pixel) const { return low_ + side_ * Point{pixel.x - 0.5, pixel.y - 0.5}; }

 private:
  double side_;
  Point low_;
  cv::Mat1b mask_;
  cv::Mat1f depth_;  // in pixels
};

// What is deeper than `radius`, in parts that are somewhere deeper by a pixel: a number for each, 0 for none.
int deep_parts(const cv::Mat1f& depth, double radius, cv::Mat1i& parts) {
  const int count = cv::connectedComponents(depth > radius, parts, 8, CV_32S);
  std::vector<int> number(count, 0);
  int deep = 0;
  for (int y = 0; y < depth.rows; ++y)
    for (int x = 0; x < depth.cols; ++x)
      if (depth(y, x) > radius + 1 && parts(y, x) > 0 && number[parts(y, x)] == 0) number[parts(y, x)] = ++deep;
  for (int& part : parts) part = number[part];
  return deep;
}

cv::Mat1f distance_to(const cv::Mat1b& set) {
  cv::Mat1f distance;
  cv::distanceTransform(set == 0, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return distance;
}

// Half way between the first part and what is next to it of the others.
cv::Point between(const cv::Mat1i& parts) {
  const cv::Mat1f first = distance_to(parts == 1), others = distance_to(parts > 1);
  const cv::Mat farther = cv::max(cv::Mat(first), cv::Mat(others));
  cv::Point middle;
  cv::minMaxLoc(farther, nullptr, nullptr, &middle);
  return middle;
}

}  // namespace

double fair_precision(const Polygon& polygon, double least) {
  constexpr double kAcross = 150;
  const Bounds box = bounds_of(polygon.outer);
  return std::max(least, std::max(box.high.x - box.low.x, box.high.y - box.low.y) / kAcross);
}

Neck narrowest_neck(const Polygon& polygon, double width, double precision) {
  if (polygon.holes.empty() && is_convex(polygon.outer)) return {};
  const Pixels pixels(polygon, precision);
  cv::Mat1i parts;
  if (deep_parts(pixels.depth(), width / 2 / precision, parts) < 2) return {};
  double least = 0;
  while (least < width && deep_parts(pixels.depth(), least / 2 / precision, parts) < 2) least += precision;
  least = std::min(least, width);
  deep_parts(pixels.depth(), least / 2 / precision, parts);
  return {least, pixels.at(between(parts))};
}

ThinPart largest_thin_part(const Polygon& polygon, double width, double precision) {
  const Pixels pixels(polygon, precision);
  const double radius = width / 2 / precision;
  const cv::Mat1b core = pixels.depth() > radius - 1;  // discs about the middles of pixels, not those between
  const cv::Mat1b missed =
      cv::countNonZero(core) > 0 ? cv::Mat1b(pixels.mask() & (distance_to(core) > radius)) : pixels.mask();
  cv::Mat1i labels;
  cv::Mat stats, centroids;
  const int count = cv::connectedComponentsWithStats(missed, labels, stats, centroids, 4, CV_32S);
  int largest = 0, area = 0;
  for (int part = 1; part < count; ++part)
    if (stats.at<int>(part, cv::CC_STAT_AREA) > area) area = stats.at<int>(largest = part, cv::CC_STAT_AREA);
  if (largest == 0) return {};
  const cv::Point middle(static_cast<int>(std::lround(centroids.at<double>(largest, 0))),
                         static_cast<int>(std::lround(centroids.at<double>(largest, 1))));
  return {area * precision * precision, pixels.at(middle)};
}

}  // namespace tessera
