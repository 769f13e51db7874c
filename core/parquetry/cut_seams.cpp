#include "tessera/parquetry/cut_seams.h"

#include <cmath>

#include "tessera/geometry/scan.h"
#include "tessera/parquetry/patches.h"
#include "tessera/parquetry/seam_curves.h"
#include "tessera/parquetry/seams.h"
#include "tessera/parquetry/spare_wood.h"
#include "tessera/parquetry/widen.h"
#include "tessera/parquetry/wood.h"

namespace tessera::parquetry {
namespace {

constexpr double kSeamsApartMm = 0.75, kAtCrossings = 0.1;  // of minWidthMm

// What a pixel's cut may be beyond its middle.
constexpr double kHalfPixel = 0.5;

// Cuts around pixels that pieces get keep the clearance, as those around their patches do, which are half a pixel
// nearer to the middles of theirs.
SpareWood spare_wood_of(const Workshop& workshop, const std::vector<Placement>& placements,
                        const std::vector<Patch>& patches) {
  const double clearance = workshop.params().clearance_mm / workshop.mm_per_px(), beside = workshop.beside();
  return SpareWood(workshop.panels(), patches, placements, clearance + 2 * (beside + kHalfPixel),
                   clearance + kHalfDiagonal + beside + kHalfPixel);
}

// The pieces of a target, which are those of the grid; its first is `first` of the patches.
Reconstruction reconstruction_of(const Workshop& workshop, const SpareWood& spare,
                                 const std::vector<Placement>& placements, const std::vector<Patch>& patches,
                                 std::size_t first) {
  Reconstruction reconstruction;
  reconstruction.target = workshop.features_of_target(patches[first].target);
  reconstruction.grid = grid_of(reconstruction.target.size(), workshop.params(), workshop.mm_per_px());
  const int growth = stray_of(reconstruction.grid, workshop.params(), workshop.mm_per_px()) +
                     static_cast<int>(std::ceil(seam_play(workshop.params(), workshop.mm_per_px())));
  reconstruction.pieces.resize(static_cast<std::size_t>(reconstruction.grid.across()) * reconstruction.grid.down());
  cv::parallel_for_({0, static_cast<int>(reconstruction.pieces.size())}, [&](const cv::Range& range) {
    for (int k = range.start; k < range.end; ++k) {
      const std::size_t i = first + k;
      const cv::Rect box = reconstruction.grid.around(patches[i].column, patches[i].row, growth);
      reconstruction.pieces[k] = {box, workshop.features_of_wood({patches[i], placements[i]}, box),
                                  spare.around(i, box)};
    }
  });
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
  const SpareWood spare = spare_wood_of(workshop, placements, patches);
  std::size_t next = 0;
  for (std::size_t target = 0; target < targets; ++target) {
    const Reconstruction reconstruction = reconstruction_of(workshop, spare, placements, patches, next);
    const Grid& grid = reconstruction.grid;
    const int stray = stray_of(grid, params, mm);
    const Seams cheapest =
        find_seams(reconstruction, {stray, kAtCrossings * params.min_width_mm / mm, kSeamsApartMm / mm});
    Seams seams = cheapest;
    widen(reconstruction, stray, (params.min_width_mm + params.seam_error_mm) / mm, seams);
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
