#include "tessera/voronoi/ridges.h"

#include <cmath>
#include <utility>

namespace tessera {
namespace {

constexpr double kFirstReach = 8;  // px
constexpr double kRim = 2;         // px: width of the ring in which a cell shows that it goes on

Sites points_of(const cv::Mat1b& edges) {
  Sites points;
  for (int y = 0; y < edges.rows; ++y)
    for (int x = 0; x < edges.cols; ++x)
      if (edges(y, x) != 0) points.push_back({.x = x + 0.5, .y = y + 0.5});
  return points;
}

// Sets the heights that are not known yet of pixels that have a label. Returns the points that reach the rim.
Sites raise(const Sites& points, const LabelMap& labels, double reach, DistanceField& heights) {
  std::vector<char> goes_on(points.size(), 0);
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) {
      const int label = labels(y, x);
      if (label == kUnlabelled || heights(y, x) != kNoFrontier) continue;
      const double dx = x + 0.5 - points[label].x, dy = y + 0.5 - points[label].y;
      const double distance = std::sqrt(dx * dx + dy * dy);
      heights(y, x) = static_cast<float>(distance);
      goes_on[label] |= distance > reach - kRim;
    }
  Sites rest;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (goes_on[i] != 0) rest.push_back(points[i]);
  return rest;
}

}  // namespace

Result<DistanceField> ridge_distance(const cv::Mat1b& edges, Rasterizer& rasterizer) {
  DistanceField heights(edges.size(), kNoFrontier);
  const cv::Mat1b plain = cv::Mat1b::zeros(edges.size());
  LabelMap labels;
  Sites points = points_of(edges);
  for (double reach = kFirstReach; !points.empty(); reach *= 2) {
    if (auto ready = rasterizer.begin(plain, Metric::kFrustum, reach); !ready) return tl::unexpected(ready.error());
    if (auto drawn = rasterizer.label(points, labels); !drawn) return tl::unexpected(drawn.error());
    points = raise(points, labels, reach, heights);
  }
  return heights;
}

}  // namespace tessera
