// Shapes of tiles (paper, 5.3 and 7): outlines from cells.
#pragma once

#include <vector>

#include "tessera/geometry/polygon.h"
#include "tessera/mosaic/diagram.h"

namespace tessera::mosaic {

// One ring a cell, in px, grout taken away; empty where a cell has none left. With params.chips those of chips
// follow.
std::vector<Ring> shape_tiles(const Diagram& diagram, const Fields& fields, const Params& params);

}  // namespace tessera::mosaic
