// How far polygons are apart. What is inside an outline counts as part of it, its holes too: nothing is cut from the
// wood in them.
#pragma once

#include "tessera/geometry/polygon.h"

namespace tessera::parquetry {

bool contains(const Ring& ring, Point p);
double distance_to_sides(const Ring& ring, Point p);  // > 0 inside too
double distance(const Ring& ring, Point p);           // 0 inside

// Whether no point of one is nearer than `distance` to one of the other. False where they overlap or
// touch.
bool are_apart(const Ring& a, const Ring& b, double distance);

}  // namespace tessera::parquetry
