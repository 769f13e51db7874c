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
};

// Sites after Lloyd's iterations, and the pixels nearest to each.
struct Relaxed {
  Sites sites;  // those that came, then one for each patch that none of them reached
  LabelMap labels;
  std::vector<cv::Point> patches;  // each one's first pixel in reading order
  int reseeded = 0;                // empty cells that were seeded again
};

// How far from a site its cell may reach, px of the diagram.
double reach_of(const Fields& fields);

// Lloyd's iterations from `first`. Positions are in pixels of `fields`, the noise is that of the whole drawing.
Result<Relaxed> relax_sites(Sites first, const Fields& fields, const NoiseDirection& noise, const Params& params,
                            Rasterizer& rasterizer, const RunContext& context, const IterationObserver& observer);

// The cells of sites with the pixels nearest to each.
Diagram diagram_of(Sites sites, LabelMap labels, const Fields& fields);

}  // namespace tessera::pavement
