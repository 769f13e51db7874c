// The centroidal Voronoi diagram in the tiles' own frames (paper, 3 and 6).
#pragma once

#include "tessera/base/run_context.h"
#include "tessera/mosaic/fields.h"
#include "tessera/voronoi/lloyd.h"
#include "tessera/voronoi/trace.h"

namespace tessera::mosaic {

struct Diagram {
  Sites sites;
  LabelMap labels;  // connected cells, none within another
  CellGraph graph;  // their boundaries
  int own = 0;      // so many sites come first; the others are their ghosts in a torus' margin
  int cells = 0;    // the first sites.size() of them belong to the sites; a site may have lost its own
  int iterations = 0;
  int reseeded = 0;
};

// Lloyd's iterations from `sites`. Squares that line up need the Chebyshev metric in the tile's frame; the paper's
// Manhattan pyramid is the same, turned by 45 degrees.
Result<Diagram> relax_diagram(Sites sites, const Fields& fields, const Params& params, Rasterizer& rasterizer,
                              const RunContext& context, const IterationObserver& observer);

}  // namespace tessera::mosaic
