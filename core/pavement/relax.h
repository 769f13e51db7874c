// Straightening: vertices move until every flat angle is flat.
#pragma once

#include <vector>

#include "tessera/pavement/place_vertices.h"

namespace tessera::pavement {

// Projects the constraints one after the other, in rounds: a flat slot's vertex onto the line between its neighbours,
// which give way a little; other corners out of hollows. Frontier and border vertices slide only along theirs.
//
// A stone that came out of it tangled goes back to where it began, and its vertices are flat no more (`flat` is
// changed).
void relax(Tessellation& t, std::vector<char>& flat, const Fields& fields);

}  // namespace tessera::pavement
