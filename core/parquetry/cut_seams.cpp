#include "tessera/parquetry/cut_seams.h"

#include "tessera/geometry/scan.h"
#include "tessera/parquetry/patches.h"
#include "tessera/parquetry/seam_curves.h"
#include "tessera/parquetry/seams.h"
#include "tessera/parquetry/widen.h"

namespace tessera::parquetry {
namespace {

constexpr double kSeamsApartMm = 0.75, kAtCrossings = 0.15;  // of minWidthMm

// The pieces of a target, which are those of the grid.
Reconstruction reconstruction_of(const Workshop& workshop, const std::vector<Placement>& placements,
                                 const std::vector<Patch>& patches, int target) {
  Reconstruction reconstruction;
  reconstruction.target = workshop.features_of_target(target);
  reconstruction.grid = grid_of(reconstruction.target.size(), workshop.params(), workshop.mm_per_px());
  for (std::size_t i = 0; i < patches.size(); ++i)
    if (patches[i].target == target)
      reconstruction.pieces.push_back({patches[i].box, workshop.features_of_wood({patches[i], placements[i]})});
  return reconstruction;
}

std::int64_t cost_within(const Ring& outline, const Reconstruction& reconstruction,
                         const Reconstruction::Piece& piece) {
  std::int64_t sum = 0;
  each_run(outline, reconstruction.target.cols, reconstruction.target.rows, [&](int y, int begin, int end) {
    for (int x = begin; x < end; ++x) sum += reconstruction.error(piece, x, y);
  });
  return sum;
}

}  // namespace

SeamCosts cut_seams(const Workshop& workshop, std::size_t targets, const std::vector<Placement>& placements,
                    std::vector<Patch>& patches) {
  SeamCosts costs;
  const Params& params = workshop.params();
  const double mm = workshop.mm_per_px();
  const Joints joints = params.seams == SeamKind::kG1 ? Joints::kG1 : Joints::kG0;
  std::size_t next = 0;
  for (std::size_t target = 0; target < targets; ++target) {
    const Reconstruction reconstruction = reconstruction_of(workshop, placements, patches, static_cast<int>(target));
    const Grid& grid = reconstruction.grid;
    const int stray = overlap_of(grid, params, mm).stray;
    const Seams cheapest =
        find_seams(reconstruction, {stray, kAtCrossings * params.min_width_mm / mm, kSeamsApartMm / mm});
    Seams seams = cheapest;
    widen(grid, stray, (params.min_width_mm + params.seam_error_mm) / mm, seams);
    const SeamNetwork network = network_of(grid, seams, params.seam_error_mm / mm, joints);
    for (const Reconstruction::Piece& piece : reconstruction.pieces) {
      Patch& patch = patches[next++];
      patch.outline.outer = network.outline(patch.column, patch.row);
      costs.cut += cost_within(patch.outline.outer, reconstruction, piece);
    }
    costs.straight += cost_of(reconstruction, straight_seams(grid));
    costs.moved += share_moved(cheapest, seams) / static_cast<double>(targets);
  }
  return costs;
}

}  // namespace tessera::parquetry
