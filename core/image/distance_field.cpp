#include "tessera/image/distance_field.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace tessera {
namespace {

// 0 where a 4-neighbour is of another zone, else 255.
cv::Mat1b frontier_pixels(const cv::Mat1b& zones) {
  cv::Mat1b inner(zones.size(), static_cast<unsigned char>(255));
  for (int y = 0; y < zones.rows; ++y) {
    const unsigned char* row = zones[y];
    const unsigned char* next = zones[std::min(y + 1, zones.rows - 1)];
    unsigned char* out = inner[y];
    unsigned char* out_next = inner[std::min(y + 1, zones.rows - 1)];
    for (int x = 0; x < zones.cols; ++x) {
      if (x + 1 < zones.cols && row[x] != row[x + 1]) out[x] = out[x + 1] = 0;
      if (row[x] != next[x]) out[x] = out_next[x] = 0;
    }
  }
  return inner;
}

bool differs_diagonally(const cv::Mat1b& zones, int x, int y) {
  for (int dy : {-1, 1}) {
    for (int dx : {-1, 1}) {
      const int i = x + dx, j = y + dy;
      if (i >= 0 && j >= 0 && i < zones.cols && j < zones.rows && zones(j, i) != zones(y, x)) return true;
    }
  }
  return false;
}

}  // namespace

DistanceField exact_distance(const cv::Mat1b& zones) {
  const cv::Mat1b inner = frontier_pixels(zones);
  if (cv::countNonZero(inner) == static_cast<int>(inner.total())) return {zones.size(), kNoFrontier};
  DistanceField field;
  cv::distanceTransform(inner, field, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  field += 0.5f;
  return field;
}

DistanceField edge_distance(const cv::Mat1b& edges) {
  if (cv::countNonZero(edges) == 0) return {edges.size(), kNoFrontier};
  DistanceField field;
  cv::distanceTransform(edges == 0, field, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return field;
}

DistanceField chamfer_distance(const cv::Mat1b& zones) {
  constexpr float kDiagonal = 1.41421356f;
  const cv::Mat1b inner = frontier_pixels(zones);
  DistanceField field(zones.size(), kNoFrontier);
  for (int y = 0; y < zones.rows; ++y) {
    for (int x = 0; x < zones.cols; ++x) {
      if (inner(y, x) == 0) {
        field(y, x) = 0.5f;
      } else if (differs_diagonally(zones, x, y)) {
        field(y, x) = kDiagonal / 2;
      }
    }
  }
  const auto relax = [&](int x, int y, int dx, int dy) {
    const int i = x + dx, j = y + dy;
    if (i < 0 || j < 0 || i >= field.cols || j >= field.rows) return;
    field(y, x) = std::min(field(y, x), field(j, i) + (dx != 0 && dy != 0 ? kDiagonal : 1.0f));
  };
  for (int y = 0; y < field.rows; ++y)
    for (int x = 0; x < field.cols; ++x)
      for (const auto& [dx, dy] : {std::pair{-1, 0}, {-1, -1}, {0, -1}, {1, -1}}) relax(x, y, dx, dy);
  for (int y = field.rows - 1; y >= 0; --y)
    for (int x = field.cols - 1; x >= 0; --x)
      for (const auto& [dx, dy] : {std::pair{1, 0}, {1, 1}, {0, 1}, {-1, 1}}) relax(x, y, dx, dy);
  return field;
}

cv::Vec2d uphill(const DistanceField& field, double x, double y, int step) {
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const auto value = [&](int dx, int dy) -> double {
    return field(std::clamp(j + dy * step, 0, field.rows - 1), std::clamp(i + dx * step, 0, field.cols - 1));
  };
  const double gx = value(1, -1) + 2 * value(1, 0) + value(1, 1) - value(-1, -1) - 2 * value(-1, 0) - value(-1, 1);
  const double gy = value(-1, 1) + 2 * value(0, 1) + value(1, 1) - value(-1, -1) - 2 * value(0, -1) - value(1, -1);
  const double norm = std::sqrt(gx * gx + gy * gy);
  return norm < 1e-6 ? cv::Vec2d(0, 0) : cv::Vec2d(gx / norm, gy / norm);
}

float at(const DistanceField& field, double x, double y) {
  const double u = std::clamp(x - 0.5, 0.0, field.cols - 1.0), v = std::clamp(y - 0.5, 0.0, field.rows - 1.0);
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const int i1 = std::min(i + 1, field.cols - 1), j1 = std::min(j + 1, field.rows - 1);
  const float a = static_cast<float>(u - i), b = static_cast<float>(v - j);
  return (1 - b) * ((1 - a) * field(j, i) + a * field(j, i1)) + b * ((1 - a) * field(j1, i) + a * field(j1, i1));
}

}  // namespace tessera
