// The point process that drives a model (section 2).
#pragma once

#include <vector>

#include "tessera/base/rng.h"
#include "tessera/image/image_view.h"
#include "tessera/patterns/params.h"
#include "tessera/points/window.h"

namespace tessera::patterns {

// Points in the window, and within `reach` of it where it is not periodic.
std::vector<Point> driving_points(const ImageView& picture, const Params& params, const Window& window, double reach,
                                  Rng& rng);

// How far beyond the window points matter to Voronoi cells in it.
double reach_of_cells(const Params& params);

}  // namespace tessera::patterns
