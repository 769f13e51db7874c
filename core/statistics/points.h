// Second-order statistics of points (section 2): how many others a point has about it.
#pragma once

#include <vector>

#include "tessera/points/window.h"

namespace tessera::statistics {

struct PointStatistics {
  double intensity = 0;  // points a unit of area
  double nearest = 0;    // mean distance to the nearest other point; 0 for less than two points
  std::vector<double> radii;
  std::vector<double> k;                 // Ripley's K(t), about points at least t from the border only
  std::vector<double> pair_correlation;  // 1 for a Poisson process: over the ring from the radius before to this one
};

// Points in the window, radii rising and below half of its shorter side. O(n) for radii of the order of a point's
// share of the window.
PointStatistics point_statistics(const std::vector<Point>& points, const Window& window,
                                 const std::vector<double>& radii);

}  // namespace tessera::statistics
