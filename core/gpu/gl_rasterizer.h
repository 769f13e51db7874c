// The OpenGL ES 3.0 backend, which is the WebGL2 one too: it knows GL, but neither EGL nor the browser.
#pragma once

#include <memory>

#include "tessera/base/status.h"
#include "tessera/voronoi/rasterizer.h"

namespace tessera {

struct GlRasterizerOptions {
  // Larger canvases are drawn in tiles of at most this side, px, at least 3. It bounds the memory on the card (17
  // bytes a pixel), and how far single precision must reach; the driver's own limit may be lower.
  int tile_limit = 4096;
};

// Draws with the context that is current on the calling thread. The same one must be current in every call and in the
// destructor. Calls leave its state changed; of others' state, no sampler or pixel buffer may be bound, and nothing
// may be skipped in pixel storage. kInternal, saying what failed, where there is no such context, where it is lost
// and where its memory does not suffice. At most 2^24 sites. Time grows with the number of sites times the square of
// the reach.
//
// Tolerance: a pixel's site is the nearest one, or farther by at most 0.5 % of the distance (cones have facets) and
// GL's grid for vertices (1/16 px where it is coarsest), which happens to less than one pixel in a thousand. Identical
// sites, and equal distances, go to the lower index.
Result<std::unique_ptr<Rasterizer>> make_gl_rasterizer(const GlRasterizerOptions& options = {});

}  // namespace tessera
