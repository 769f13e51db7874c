// What tables say of a piece.
#pragma once

#include <cstddef>

#include "tessera/geometry/piece.h"

namespace tessera {

struct Measures {
  double area = 0;           // px^2, without holes
  double perimeter = 0;      // px, with the holes' borders
  std::size_t vertices = 0;  // with those of holes
  double orientation = 0;    // degrees, [0, 180), still so when rounded to 3 decimals
  Point centroid;            // centre of mass, holes left out
};

Measures measure(const Polygon& outline);

}  // namespace tessera
