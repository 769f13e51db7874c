// Which vertices are corners of which stones.
#pragma once

#include <vector>

#include "tessera/pavement/place_vertices.h"

namespace tessera::pavement {

// One flag a slot of the map's rings: true where the stone's outline shall run straight through the vertex.
//
// The paper flattens every angle wider than 120 degrees, one after the other (III.C). But three stones meet at most
// vertices, and if each vertex lies flat on the side of exactly one of them, stones have four corners on average.
// Which one is an assignment problem: vertices to stones, each stone taking as many as it has vertices above four, at
// the least total distance that vertices have to move. Solved by the flattest first, then augmenting paths.
std::vector<char> match_corners(const Tessellation& t, double half_side);

}  // namespace tessera::pavement
