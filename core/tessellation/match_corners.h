// Which vertices are corners of which pieces.
#pragma once

#include <vector>

#include "tessera/tessellation/tessellation.h"

namespace tessera {

// One flag a slot of the map's rings: true where the piece's outline shall run straight through the vertex.
//
// The pavement paper flattens every angle wider than 120 degrees, one after the other (III.C). But three pieces meet
// at most vertices, and if each vertex lies flat on the side of exactly one of them, pieces have four corners on
// average. Which one is an assignment problem: vertices to pieces, each piece taking as many as it has vertices above
// four, at the least total distance that vertices have to move. Solved by the flattest first, then augmenting paths.
std::vector<char> match_corners(const Tessellation& t);

}  // namespace tessera
