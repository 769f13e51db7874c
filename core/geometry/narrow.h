// Where an outline is so narrow that what is cut along it breaks. By pixels of side `precision` (> 0): widths are
// right to about one of them.
#pragma once

#include <limits>

#include "tessera/geometry/polygon.h"

namespace tessera {

// A precision for a polygon: a 150th of its extent, or `least` if that is more.
double fair_precision(const Polygon& polygon, double least);

struct Neck {
  double width = std::numeric_limits<double>::infinity();
  Point at;
};

// The least width at which the polygon falls apart when it is eroded by half of it, of those below `width`; infinite
// where it does not. Parts that are not deeper by a pixel do not count.
Neck narrowest_neck(const Polygon& polygon, double width, double precision);

struct ThinPart {
  double area = 0;
  Point at;
};

// The largest connected part that no disc of diameter `width` inside the polygon reaches: a tail, a sharp corner, all
// of a polygon that is too narrow. A right angle's is 0.05 width^2, one of 44 degrees has 0.33 width^2.
ThinPart largest_thin_part(const Polygon& polygon, double width, double precision);

}  // namespace tessera
