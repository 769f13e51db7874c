// Simple polygons and what is measured of them.
#pragma once

#include <vector>

#include "tessera/geometry/point.h"

namespace tessera {

using Ring = std::vector<Point>;

// A simple outline; the last vertex is joined to the first, none is repeated. Positive area means clockwise on the
// screen (y down).
struct Polygon {
  Ring outer;
  std::vector<Ring> holes;
};

double signed_area(const Ring& ring);
double area(const Polygon& polygon);     // without its holes, >= 0
double perimeter(const Ring& ring);
Point centroid(const Ring& ring);        // centre of mass; the vertices' mean where the area is zero
bool is_convex(const Ring& ring, double tolerance_sine = 1e-9);  // no turn against the ring's sense
// Direction of the longer side of the least rectangle around the ring, in degrees, [0, 180), from x towards y.
double orientation_deg(const Ring& ring);
bool is_simple(const Ring& ring);        // no side crosses or touches another; brute force, for short rings

}  // namespace tessera
