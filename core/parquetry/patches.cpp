#include "tessera/parquetry/patches.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tessera/image/resample.h"

namespace tessera::parquetry {
namespace {

Patch rectangle(cv::Rect box, int row, int column, int level, int target) {
  Patch patch;
  patch.row = row;
  patch.column = column;
  patch.level = level;
  patch.target = target;
  const double left = box.x, top = box.y, right = box.x + box.width, bottom = box.y + box.height;
  patch.outline.outer = {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
  patch.box = box;
  patch.mask = cv::Mat1b(box.size(), 255);
  return patch;
}

}  // namespace

cv::Mat3b at_resolution(const cv::Mat3b& target, const Params& params, double mm_per_px) {
  const std::int64_t shorter = std::min(target.cols, target.rows);
  const int wanted = std::max(1, static_cast<int>(std::lround(params.image_size_mm / mm_per_px)));
  const auto size = [&](int side) {
    return side == shorter ? wanted : static_cast<int>((2 * std::int64_t{side} * wanted + shorter) / (2 * shorter));
  };
  const cv::Size to(size(target.cols), size(target.rows));
  if (wanted <= shorter)
    return resampled({target.data, target.cols, target.rows, static_cast<std::ptrdiff_t>(target.step)},
                     {target.cols, to.width}, {target.rows, to.height}, to);
  cv::Mat3b larger;
  cv::resize(target, larger, to, 0, 0, cv::INTER_LINEAR_EXACT);
  return larger;
}

bool has_proportions(const ImageView& picture, cv::Size target) {
  constexpr double kOff = 0.01;
  const double stretched =
      static_cast<double>(picture.width) * target.height / (static_cast<double>(picture.height) * target.width);
  return std::abs(stretched - 1) <= kOff;
}

std::vector<int> even_cuts(int length, double wanted, double least) {
  const auto most = std::max(1, static_cast<int>(length / std::max(1.0, std::ceil(least))));
  const int parts = std::clamp(static_cast<int>(std::lround(length / std::max(1.0, wanted))), 1, most);
  std::vector<int> cuts;
  for (std::int64_t i = 0; i <= parts; ++i) cuts.push_back(static_cast<int>(i * length / parts));
  return cuts;
}

Grid grid_of(cv::Size target, const Params& params, double mm_per_px) {
  const double wanted = params.patch_mm / mm_per_px, least = params.min_width_mm / mm_per_px;
  return {even_cuts(target.width, wanted, least), even_cuts(target.height, wanted, least)};
}

double seam_play(const Params& params, double mm_per_px) {
  if (params.seams == SeamKind::kNone) return 0;
  // Beside the cut: its curve; at its ends the kerf's corners, those of 44 degrees (seams.h) the longest.
  constexpr double kEvenedOut = 0.5, kCorner = 0.84;
  return kEvenedOut + std::max(params.seam_error_mm, kCorner * params.kerf_mm) / mm_per_px;
}

int stray_of(const Grid& grid, const Params& params, double mm_per_px) {
  if (params.seams == SeamKind::kNone) return 0;
  int narrowest = grid.columns.back() + grid.rows.back();
  for (int column = 0; column < grid.across(); ++column) narrowest = std::min(narrowest, grid.cell(column, 0).width);
  for (int row = 0; row < grid.down(); ++row) narrowest = std::min(narrowest, grid.cell(0, row).height);
  const double overlap_mm = params.overlap_mm > 0 ? params.overlap_mm : params.patch_mm / 4;
  const double half = 0.5 * overlap_mm / mm_per_px;
  const double spare = 0.5 * (narrowest - params.min_width_mm / mm_per_px) - params.seam_error_mm / mm_per_px - 0.5;
  return std::max(0, static_cast<int>(std::floor(std::min(half - seam_play(params, mm_per_px), spare))));
}

std::vector<Patch> grid_patches(cv::Size target, const Params& params, double mm_per_px, int target_index) {
  const Grid grid = grid_of(target, params, mm_per_px);
  std::vector<Patch> patches;
  for (int row = 0; row < grid.down(); ++row)
    for (int column = 0; column < grid.across(); ++column)
      patches.push_back(rectangle(grid.cell(column, row), row, column, 0, target_index));
  return patches;
}

std::vector<Patch> quarters(const Patch& patch, const Params& params, double mm_per_px) {
  const cv::Rect& box = patch.box;
  if (patch.outline.outer.size() != 4 || !patch.outline.holes.empty() || cv::countNonZero(patch.mask) != box.area())
    return {};
  const int half = std::min(box.width, box.height) / 2;
  if (half < std::max(1.0, params.min_width_mm / mm_per_px)) return {};
  const Grid grid{{box.x, box.x + box.width / 2, box.x + box.width},
                  {box.y, box.y + box.height / 2, box.y + box.height}};
  std::vector<Patch> parts;
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 2; ++column)
      parts.push_back(rectangle(grid.cell(column, row), patch.row, patch.column, patch.level + 1, patch.target));
  return parts;
}

}  // namespace tessera::parquetry
