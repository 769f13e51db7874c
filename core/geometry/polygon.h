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

// The least rectangle along the axes around a ring that has vertices.
struct Bounds {
  Point low, high;
};
Bounds bounds_of(const Ring& ring);

double signed_area(const Ring& ring);
double area(const Polygon& polygon);  // without its holes, >= 0
double perimeter(const Ring& ring);
Point centroid(const Ring& ring);                   // centre of mass; the vertices' mean where the area is zero
Point centroid_with_holes(const Polygon& polygon);  // of what holes leave of it; of an area above zero
bool is_convex(const Ring& ring, double tolerance_sine = 1e-9);  // no turn against the ring's sense
// Direction of the longer side of the least rectangle around the ring, in degrees, [0, 180), from x towards y.
double orientation_deg(const Ring& ring);
bool is_simple(const Ring& ring);  // no side crosses or touches another; brute force, for short rings

// Each side moved inwards by `distance`, corners where they meet; for short rings that are simple and clockwise on
// the screen. Where a ring is too narrow for that, by less: by a half, a quarter, an eighth, not at all.
Ring inset(const Ring& ring, double distance);

// What of a ring is inside a convex window, both clockwise on the screen (Sutherland and Hodgman); empty where
// nothing is. Parts of a hollow ring stay joined by sides of no width.
Ring clip_convex(const Ring& window, const Ring& ring);

}  // namespace tessera
