// Straightening: vertices move until every flat angle is flat.
#pragma once

#include <functional>
#include <vector>

#include "tessera/tessellation/tessellation.h"

namespace tessera {

// Where a vertex belongs that has moved to `p`: on the frontier it is bound to, within the picture. Called from
// several threads.
using Back = std::function<Point(int vertex, Point p)>;

// Projects the constraints one after the other, in rounds: a flat slot's vertex onto the line between its neighbours,
// which give way a little; other corners out of hollows. Frontier and border vertices slide only along theirs.
//
// A piece that came out of it tangled goes back to where it began, and its vertices are flat no more (`flat` is
// changed).
void relax(Tessellation& t, std::vector<char>& flat, const Back& back);

}  // namespace tessera
