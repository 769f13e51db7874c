// Triangles that fill a polygon.
#pragma once

#include <cstdint>
#include <vector>

#include "tessera/geometry/polygon.h"

namespace tessera {

// Three indices a triangle, into the vertices of the outer ring and then of each hole, in the sense of a ring that is
// clockwise on the screen. Holes lie inside the outer ring and apart. Ear clipping, each hole first joined to the
// ring by a side (D. Eberly, "Triangulation by Ear Clipping"); quadratic, for short rings. As many triangles of a
// ring that crosses itself, though some are turned over: its sides still border one triangle each.
std::vector<std::uint32_t> triangulate(const Polygon& polygon);

}  // namespace tessera
