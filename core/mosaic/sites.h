// First positions of the tiles.
#pragma once

#include <cstdint>

#include "tessera/mosaic/fields.h"
#include "tessera/voronoi/site.h"

namespace tessera::mosaic {

// A site's frame at its position: the field's direction, half sides of a tile there.
void turn_and_size(Site& site, const Fields& fields, const Params& params);

// The paper's (5.2): random positions, each accepted with probability (s_min / s)^2.
Sites random_sites(const Fields& fields, const Params& params, std::uint64_t seed);

// Row after row: the first ones half a tile from the edges, each tile beside one that lies already, the next rows
// along these; what is left over is filled in reading order. The sides in `fields` are scaled until about
// params.tiles find room.
Sites rows_of_sites(Fields& fields, const Params& params);

}  // namespace tessera::mosaic
