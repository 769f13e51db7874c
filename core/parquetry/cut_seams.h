// Where patches overlap, their pieces are cut so that the picture gains most (3.4, a-posteriori refinement).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tessera/parquetry/assign.h"
#include "tessera/parquetry/patch.h"

namespace tessera::parquetry {

struct SeamCosts {
  std::int64_t cut = 0, straight = 0;  // Eq. 8, as they are cut, and with straight cuts between the same pieces
  double moved = 0;                    // share of the seams' pixels that had to go back for pieces to be wide enough
};

// Gives the patches, which are those of the grid (grid_patches()) in its order, target by target, the outlines that
// they are cut by: the target's parts, sides shared to the last bit.
SeamCosts cut_seams(const Workshop& workshop, std::size_t targets, const std::vector<Placement>& placements,
                    std::vector<Patch>& patches);

}  // namespace tessera::parquetry
