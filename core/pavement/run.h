// Portuguese pavement: a drawing in, its stones out.
#pragma once

#include <cstdint>
#include <vector>

#include "tessera/base/run_context.h"
#include "tessera/geometry/piece.h"
#include "tessera/image/image_view.h"
#include "tessera/pavement/params.h"
#include "tessera/voronoi/lloyd.h"

namespace tessera::pavement {

struct Output {
  PieceSheet sheet;                  // in source pixels
  int first_id = 1;                  // of its pieces
  int sites = 0;                     // n of Eq. 1, before hairlines were given more
  int reseeded = 0;                  // empty cells that were seeded again
  std::vector<int> vertices_before;  // Fig. 9: vertices a cell right after tracing, in sheet order
  std::vector<int> vertices_after;   // Fig. 9: vertices a stone
  std::vector<double> areas;         // Fig. 12: stone areas, px^2
};

// `drawing` is read during the call only. Fails with kInvalidInput for a picture without pixels or one too small to
// hold a stone, kCancelled or kTimeout as `context` says. Same arguments, same result, for any number of threads.
Result<Output> run(const ImageView& drawing, const Params& requested, std::uint64_t seed, Rasterizer& rasterizer,
                   const RunContext& context, const IterationObserver& observer = {});

}  // namespace tessera::pavement
