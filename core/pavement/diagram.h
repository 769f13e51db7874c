// The centroidal Voronoi diagram (paper, III.B).
#pragma once

#include "tessera/base/run_context.h"
#include "tessera/pavement/fields.h"
#include "tessera/pavement/params.h"
#include "tessera/voronoi/lloyd.h"
#include "tessera/voronoi/trace.h"

namespace tessera::pavement {

struct Diagram {
  Sites sites;
  LabelMap labels;  // connected cells, none within another
  CellGraph graph;  // their boundaries
  int cells = 0;    // the first sites.size() of them belong to the sites; a site may have lost its own
  std::vector<std::uint8_t> cell_zone;
  int reseeded = 0;
};

// Lloyd's iterations from `sites`.
Result<Diagram> relax_diagram(Sites sites, const Fields& fields, const Params& params, std::uint64_t seed,
                              Rasterizer& rasterizer, const RunContext& context, const IterationObserver& observer);

}  // namespace tessera::pavement
