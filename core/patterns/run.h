// Random patterns: a model of random geometry in, its cells out.
#pragma once

#include <cstdint>
#include <vector>

#include "tessera/base/run_context.h"
#include "tessera/geometry/piece.h"
#include "tessera/geometry/raster.h"
#include "tessera/image/image_view.h"
#include "tessera/patterns/params.h"

namespace tessera::patterns {

struct Output {
  PieceSheet sheet;           // in pixels of the window; ids from 1
  std::vector<double> areas;  // of the pieces, px^2
  double intensity = 0;       // of the driving process
};

// `density`: where the cox process has many points, dark for many; without pixels its intensity is random. All
// parameters are valid. Fails with kInvalidParameter for more than 20 million pieces, kCancelled or kTimeout as
// `context` says. Same arguments, same result.
Result<Output> run(const ImageView& density, const Params& params, std::uint64_t seed, const RunContext& context);

// Whether the picture of a pattern is more than its pieces.
bool has_finish(const Params& params);
// Makes that picture of the pieces as they were drawn: noise within cells, then the mean filter.
void finish(Raster& picture, const Params& params, std::uint64_t seed);

}  // namespace tessera::patterns
