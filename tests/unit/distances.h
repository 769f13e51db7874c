// How far a point is from a line, for tests of curves.
#pragma once

#include <algorithm>

#include "tessera/geometry/polygon.h"

namespace tessera {

// From the nearest point of an open line of two or more.
inline double distance_to(Point p, const Ring& line) {
  double least = 1e30;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Point way = line[i + 1] - line[i];
    const double share = std::clamp(dot(p - line[i], way) / dot(way, way), 0.0, 1.0);
    least = std::min(least, length(p - line[i] - share * way));
  }
  return least;
}

}  // namespace tessera
