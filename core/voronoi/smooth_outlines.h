// Outlines of cells as a saw can follow them: without the stairs of pixels.
#pragma once

#include <vector>

#include "tessera/geometry/polygon.h"
#include "tessera/voronoi/rasterizer.h"

namespace tessera {

// For each label below `cells` its outline, with holes where it encloses others; together they tile the picture.
// Boundaries are within about twice `tolerance` (px, > 0) of those between the pixels: first as few straight sides as
// that takes (Douglas and Peucker 1973), then their blunt corners cut (Chaikin 1974). Places where three and more
// cells meet stay. What two cells share is made once, so that they have the same vertices. Where smoothing would let
// a cell's boundary cross itself, it stays as it is between the pixels.
//
// All pixels are labelled, each cell is 4-connected, and no cell touches itself at a corner (part_corners).
std::vector<Polygon> smooth_outlines(const LabelMap& labels, int cells, double tolerance);

// Gives pixels to other cells until none touches itself only at a corner: where it did, the outline would meet
// itself. Cells may fall apart or vanish.
void part_corners(LabelMap& labels);

}  // namespace tessera
