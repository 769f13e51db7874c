// The regular models: squares, hexagons and triangles, shifted and turned at random (3.3).
#pragma once

#include "tessera/base/rng.h"
#include "tessera/patterns/clip.h"

namespace tessera::patterns {

enum class Lattice { kSquares, kHexagons, kTriangles };

// Cells of that side, px, cut at the window. On a periodic window they stick out, and are bent a little so that a
// whole number of them goes around.
Cells lattice_cells(Lattice lattice, double side, const Window& window, Rng& rng);

// The window's pixels, each a cell; the last ones may be cut.
Cells pixel_cells(const Window& window);

}  // namespace tessera::patterns
