// The target, cut into patches (3.4).
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "tessera/image/image_view.h"
#include "tessera/parquetry/params.h"
#include "tessera/parquetry/patch.h"

namespace tessera::parquetry {

// A target of imageSizeMm along its shorter axis, at the panels' resolution: smaller by means of areas, larger by
// bilinear interpolation. Whole numbers only: the same on every platform.
cv::Mat3b at_resolution(const cv::Mat3b& target, const Params& params, double mm_per_px);

// Whether a picture drawn over the target has its proportions, within a hundredth.
bool has_proportions(const ImageView& picture, cv::Size target);

// Where a length of pixels is cut: 0, ..., length, in parts as equal as whole pixels allow. As many as make them
// nearest to `wanted` pixels, and none narrower than `least`; but at least one part.
std::vector<int> even_cuts(int length, double wanted, double least);

// Where a target is cut into columns and rows, px: 0, ..., its width and height.
struct Grid {
  std::vector<int> columns, rows;

  int across() const { return static_cast<int>(columns.size()) - 1; }
  int down() const { return static_cast<int>(rows.size()) - 1; }
  bool operator==(const Grid&) const = default;
  cv::Rect cell(int column, int row) const {
    return {columns[column], rows[row], columns[column + 1] - columns[column], rows[row + 1] - rows[row]};
  }
  // A cell and what of the target is `margin` px around it.
  cv::Rect around(int column, int row, int margin) const {
    const cv::Point by(margin, margin);
    const cv::Rect own = cell(column, row);
    return cv::Rect(own.tl() - by, own.br() + by) & cv::Rect(0, 0, columns.back(), rows.back());
  }
};

// Rectangles near to patchMm and no narrower than minWidthMm. They are fitted to the target evenly: no thin rest is
// left at its right and lower side.
Grid grid_of(cv::Size target, const Params& params, double mm_per_px);

// How far the outline of a piece that seams cut may be beyond the sides of its pixels, px: its curves, and the
// corners of the kerf around it as far as they are beyond half of it. 0 without seams.
double seam_play(const Params& params, double mm_per_px);

// How far seams (seams.h) may go from where the grid has its cuts, px. Half of overlapMm less seam_play(); so much
// less that pieces keep minWidthMm; 0 where there are no seams, or there is no room for them.
int stray_of(const Grid& grid, const Params& params, double mm_per_px);

// A patch for each cell of the grid, row by row. With seams they are the same: the paper matches all that a patch
// overlaps, and takes it, which leaves pictures worse than straight cuts where wood is scarce. Here pieces grow into
// wood that is left over (spare_wood.h).
std::vector<Patch> grid_patches(cv::Size target, const Params& params, double mm_per_px, int target_index = 0);

// The four quarters of a patch, of the next level; empty where one would be narrower than minWidthMm, or the patch is
// no rectangle.
std::vector<Patch> quarters(const Patch& patch, const Params& params, double mm_per_px);

}  // namespace tessera::parquetry
