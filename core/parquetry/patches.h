// The target, cut into patches (3.4).
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "tessera/parquetry/params.h"
#include "tessera/parquetry/patch.h"

namespace tessera::parquetry {

// A target of imageSizeMm along its shorter axis, at the panels' resolution: smaller by means of areas, larger by
// bilinear interpolation. Whole numbers only: the same on every platform.
cv::Mat3b at_resolution(const cv::Mat3b& target, const Params& params, double mm_per_px);

// Where a length of pixels is cut: 0, ..., length, in parts as equal as whole pixels allow. As many as make them
// nearest to `wanted` pixels, and none narrower than `least`; but at least one part.
std::vector<int> even_cuts(int length, double wanted, double least);

// A regular grid of rectangles near to patchMm and no narrower than minWidthMm that covers the target, row by row.
// They are fitted to the target evenly: no thin rest is left at its right and lower side.
std::vector<Patch> grid_patches(cv::Size target, const Params& params, double mm_per_px, int target_index = 0);

// The four quarters of a patch, of the next level; empty where one would be narrower than minWidthMm, or the patch is
// no rectangle.
std::vector<Patch> quarters(const Patch& patch, const Params& params, double mm_per_px);

}  // namespace tessera::parquetry
