// Decorative mosaics: a photo in, its tiles out.
#pragma once

#include <cstdint>
#include <vector>

#include "tessera/base/run_context.h"
#include "tessera/geometry/piece.h"
#include "tessera/mosaic/fields.h"
#include "tessera/voronoi/lloyd.h"

namespace tessera::mosaic {

struct Output {
  PieceSheet sheet;           // in source pixels; ids from 1
  int iterations = 0;         // made
  int reseeded = 0;           // empty cells that were seeded again
  std::vector<double> areas;  // of the tiles, px^2
  double field_angle = 0;     // mean angle between a tile and the direction field at its centre, degrees, 0..45
  double edge_angle = 0;      // the same to the edge, of tiles at edges: nearer than 1.5 half sides
  int at_edges = 0;           // tiles through or along which an edge runs
  int crossed = 0;            // those whose inside, 15 % of their side from their border, it runs through
};

// The pictures are read during the call only; all parameters are valid. Fails with kInvalidInput for a photo without
// pixels, kCancelled or kTimeout as `context` says. Same arguments, same result, for any number of threads.
Result<Output> run(const Pictures& pictures, const Params& requested, std::uint64_t seed, Rasterizer& rasterizer,
                   const RunContext& context, const IterationObserver& observer = {});

}  // namespace tessera::mosaic
