// Each stone alone: its own outline, grout around it, its colour (paper, III.C, second half).
#pragma once

#include <vector>

#include "tessera/geometry/piece.h"
#include "tessera/pavement/params.h"
#include "tessera/pavement/place_vertices.h"

namespace tessera::pavement {

// `half_side` in pixels of the diagram, as the tessellation. Vertices where a stone is flat are left out, wide
// corners and tiny sides too as long as four corners remain. Rings may be empty where nothing of a cell is left.
std::vector<Ring> separate_stones(const Tessellation& t, const std::vector<char>& flat, const Params& params,
                                  double half_side);

// Moves each vertex towards the centre of mass by half of the grout, less for stones smaller than others. Lengths in
// source pixels.
void shrink(Ring& ring, double grout, double half_side);

}  // namespace tessera::pavement
