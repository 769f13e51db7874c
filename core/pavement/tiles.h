// Pavement of drawings too large for memory, tile by tile.
//
// The random numbers are those of the whole drawing: sites are sown in the order of its blocks as rows come in, and
// what depends on all of it is found before (whole.h). A tile's sites go through Lloyd's iterations together with
// those of a halo around it; what the tile began with it keeps. Cells are those of all the sites that came out, so
// they meet at tile borders as anywhere else. Their vertices are moved tile after tile, again with a halo, in which
// stones that are laid already stay as they are.
#pragma once

#include <functional>

#include "tessera/image/row_source.h"
#include "tessera/pavement/run.h"

namespace tessera::pavement {

// The halo of the iterations and that of the stones, in half sides.
inline constexpr double kSiteHalo = 64, kStoneHalo = 32;

// Where a stone lies farther than this from tile borders, in half sides, it is that of run(). Nothing forbids that
// some stone is not: what a stone does reaches those around it less and less, but where one is about to be tangled,
// little decides.
inline constexpr double kSameBeyond = 48;

// Takes the stones of a tile; its sheet has the size of the whole drawing, the ids go on from the tile before.
using TakePart = std::function<Result<void>(Output part)>;

struct TilesDone {
  int tiles = 0;
  int sites = 0;  // n of Eq. 1
  int reseeded = 0;
};

// As run(), for rows that come one after the other, in squares of `tiles` (> 0) source pixels; a small picture is
// one. Memory is that of three rows of tiles of the source and of a tile's diagram. Errors are those of run(), of the
// source and of `take`.
Result<TilesDone> run_tiles(RowSource& source, const Params& requested, std::uint64_t seed, Rasterizer& rasterizer,
                            const RunContext& context, const TakePart& take);

}  // namespace tessera::pavement
