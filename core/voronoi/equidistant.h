// Where sites are equally far: the vertices of a diagram, finer than its pixels.
#pragma once

#include "tessera/geometry/point.h"
#include "tessera/voronoi/site.h"

namespace tessera {

// Moves `p` to the point near it that is equally far from all three. Newton's method; false, and `p` stays, where it
// does not converge within `limit` pixels of p.
bool make_equidistant(const SiteDistance& a, const SiteDistance& b, const SiteDistance& c, double limit, Point& p);

// The same for two sites, along the line through `p` in a direction of length 1.
bool make_equidistant_along(const SiteDistance& a, const SiteDistance& b, Point direction, double limit, Point& p);

}  // namespace tessera
