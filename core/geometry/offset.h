// Outlines moved outwards, as a cutter's path lies beside the line it is to leave.
#pragma once

#include "tessera/geometry/polygon.h"

namespace tessera {

// `outline` and all around it up to `distance` (>= 0) from its sides; corners stay corners, as far as five times the
// distance. Holes become smaller, narrow bays close. Of a simple polygon, clockwise on the screen, and so is what
// comes.
Polygon grown(const Polygon& outline, double distance);

}  // namespace tessera
