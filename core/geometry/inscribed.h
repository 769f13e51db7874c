// The roomiest place in a polygon.
#pragma once

#include "tessera/geometry/polygon.h"

namespace tessera {

struct Circle {
  Point centre;
  double radius = 0;
};

// The largest circle inside the outline and outside its holes, its radius less than `precision` (> 0) below the
// largest. By quartering squares, those first that may hold the best (V. Agafonkin, polylabel, 2016).
Circle largest_inscribed(const Polygon& outline, double precision);

}  // namespace tessera
