// Squares and rectangles that overlap, moved until they hardly do.
#pragma once

#include "tessera/mosaic/torus.h"
#include "tessera/voronoi/site.h"

namespace tessera::mosaic {

// Moves sites whose tiles, rectangles of `delta` times the extents in the sites' frames, overlap: each pair apart by
// what it overlaps, the shortest way, again and again. Tiles keep their directions and stay where there is no room.
// On a torus they see each other across its seams, and may leave its window.
void push_apart(Sites& sites, double delta, const Torus& torus);

}  // namespace tessera::mosaic
