// Bombing models (section 4): figures dropped at random, in random directions.
#pragma once

#include "tessera/base/rng.h"
#include "tessera/patterns/clip.h"
#include "tessera/patterns/params.h"

namespace tessera::patterns {

// A figure about each of the centres, as the parameters say. A circle or ellipse is a polygon of the same area, whose
// vertices are at most 0.05 px off. Figures overlap, and those at the window's border stick out.
Cells drop_bombs(const std::vector<Point>& centres, const Params& params, Rng& rng);

// How far from its centre a figure reaches, at most (of random sizes: but for one in a million).
double bomb_reach(const Params& params);

// Small discs for the points of a process.
Cells draw_points(const std::vector<Point>& points, double radius);

bool is_bombing(Model model);

}  // namespace tessera::patterns
