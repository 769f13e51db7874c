// In which order the pieces of a panel are cut.
#pragma once

#include <cstddef>
#include <vector>

#include "tessera/geometry/polygon.h"

namespace tessera::parquetry {

// An order of the places with short ways between them, from the one nearest to (0, 0) on: always the nearest that is
// left, then ways that cross are uncrossed (2-opt) until none is worth it.
std::vector<std::size_t> short_tour(const std::vector<Point>& places);

// The ring from that vertex on which is nearest to `from`.
Ring begun_near(const Ring& ring, Point from);

}  // namespace tessera::parquetry
