// The target, cut into patches that follow its edges (3.4, a-priori refinement).
#pragma once

#include <vector>

#include "tessera/base/status.h"
#include "tessera/parquetry/edge_picture.h"
#include "tessera/parquetry/morphed_curves.h"
#include "tessera/parquetry/morphing_grid.h"
#include "tessera/parquetry/params.h"
#include "tessera/parquetry/patch.h"

namespace tessera::parquetry {

// The steps one by one, for pages on which people morph a grid. `target` is at the panels' resolution.
EdgePicture edge_picture_of(const cv::Mat3b& target, const Params& params, double mm_per_px,
                            const EdgeMasks& masks = {});
EdgePicture edge_picture_of(const FoundEdges& counting, cv::Size target, const Params& params, double mm_per_px);
// `edges` outlive the grid. Fails with kInvalidParameter for pins of vertices that the grid has not, or that may not
// leave their border or corner; with the places of all such.
Result<MorphingGrid> morphing_grid_of(cv::Size target, const EdgePicture& edges, const Params& params,
                                      double mm_per_px);
MorphedCells cells_of(const MorphingGrid& grid, const EdgePicture& edges, const Params& params, double mm_per_px);

// A patch for each cell; for cells along whose diagonal an edge of the picture runs, two triangles, parts 0 and 1 of
// one place.
std::vector<Patch> patches_of_cells(const MorphedCells& cells, cv::Size target, int target_index = 0);

// All of it. Fails with kInvalidParameter for pins as above, and for such as cannot be reached because cells would
// become too narrow.
Result<std::vector<Patch>> morphed_patches(const cv::Mat3b& target, const Params& params, double mm_per_px,
                                           const EdgeMasks& masks = {}, int target_index = 0);

}  // namespace tessera::parquetry
