#include "tessera/parquetry/morphed_patches.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tessera/geometry/scan.h"
#include "tessera/parquetry/patches.h"

namespace tessera::parquetry {
namespace {

constexpr double kOnBorder = 0.01;  // mm that a pin may be off the border whose vertex it holds

cv::Rect box_of(const Ring& ring, cv::Size target) {
  const auto [low, high] = bounds_of(ring);
  const cv::Point from(static_cast<int>(std::floor(low.x)), static_cast<int>(std::floor(low.y)));
  const cv::Point to(static_cast<int>(std::ceil(high.x)), static_cast<int>(std::ceil(high.y)));
  return cv::Rect(from, to) & cv::Rect({0, 0}, target);
}

std::vector<Pin> pins_in_px(const Params& params, double mm_per_px) {
  std::vector<Pin> pins = read_pins(params.pins);
  for (Pin& pin : pins) pin.at = (1 / mm_per_px) * pin.at;
  return pins;
}

std::string name_of(const Pin& pin) { return fmt::format("{},{}", pin.column, pin.row); }

// What is wrong with a pin; empty where nothing is. On the border it becomes exactly that.
std::string check(const Grid& grid, double mm_per_px, Pin& pin) {
  if (pin.column > grid.across() || pin.row > grid.down())
    return fmt::format("has vertex {}, expected at most {},{}", name_of(pin), grid.across(), grid.down());
  const auto hold = [&](int k, const std::vector<int>& cuts, double& at) {
    if (k > 0 && k + 1 < static_cast<int>(cuts.size())) return true;
    const bool good = std::abs(at - cuts[k]) * mm_per_px <= kOnBorder;
    if (good) at = cuts[k];
    return good;
  };
  const bool across = hold(pin.column, grid.columns, pin.at.x), down = hold(pin.row, grid.rows, pin.at.y);
  if (across && down) return "";
  return fmt::format("moves vertex {} off the border, expected a place on it", name_of(pin));
}

Result<void> failed(const std::string& all) {
  if (all.empty()) return {};
  return fail(StatusCode::kInvalidParameter, "pins", all);
}

void add(const std::string& problem, std::string& all) {
  if (!problem.empty()) all += (all.empty() ? "" : "; ") + problem;
}

}  // namespace

EdgePicture edge_picture_of(const cv::Mat3b& target, const Params& params, double mm_per_px, const EdgeMasks& masks) {
  const FoundEdges found = edges_of(target, grid_of(target.size(), params, mm_per_px));
  return edge_picture_of(masked(found, masks), target.size(), params, mm_per_px);
}

EdgePicture edge_picture_of(const FoundEdges& counting, cv::Size target, const Params& params, double mm_per_px) {
  const double reach = params.attraction_mm > 0 ? params.attraction_mm : 0.5 * params.patch_mm;
  return {counting, target, reach / mm_per_px};
}

Result<MorphingGrid> morphing_grid_of(cv::Size target, const EdgePicture& edges, const Params& params,
                                      double mm_per_px) {
  const Grid grid = grid_of(target, params, mm_per_px);
  MorphingGrid morphing(grid, edges, params.attraction, params.min_width_mm / mm_per_px);
  std::string problems;
  for (Pin& pin : pins_in_px(params, mm_per_px)) {
    const std::string problem = check(grid, mm_per_px, pin);
    add(problem, problems);
    if (problem.empty()) morphing.pin(pin);
  }
  if (auto good = failed(problems); !good) return tl::unexpected(good.error());
  return morphing;
}

MorphedCells cells_of(const MorphingGrid& grid, const EdgePicture& edges, const Params& params, double mm_per_px) {
  return cells_of(grid, edges, CurveLimits{params.seam_error_mm / mm_per_px, params.min_width_mm / mm_per_px});
}

std::vector<Patch> patches_of_cells(const MorphedCells& cells, cv::Size target, int target_index) {
  std::vector<Patch> patches;
  for (int row = 0; row < cells.network.down; ++row)
    for (int column = 0; column < cells.network.across; ++column)
      for (int part = 0; const Ring& outline : cells.outlines(column, row)) {
        Patch patch;
        patch.row = row;
        patch.column = column;
        patch.part = part++;
        patch.target = target_index;
        patch.outline.outer = outline;
        patch.box = box_of(outline, target);
        patch.mask = cv::Mat1b(patch.box.size(), static_cast<std::uint8_t>(0));
        each_run(outline, target.width, target.height, [&](int y, int begin, int end) {
          patch.mask.row(y - patch.box.y).colRange(begin - patch.box.x, end - patch.box.x).setTo(255);
        });
        patches.push_back(std::move(patch));
      }
  return patches;
}

Result<std::vector<Patch>> morphed_patches(const cv::Mat3b& target, const Params& params, double mm_per_px,
                                           const EdgeMasks& masks, int target_index) {
  const EdgePicture edges = edge_picture_of(target, params, mm_per_px, masks);
  auto grid = morphing_grid_of(target.size(), edges, params, mm_per_px);
  if (!grid) return tl::unexpected(grid.error());
  grid->settle();
  std::string problems;
  for (const Pin& pin : grid->pins())
    if (!grid->is_in_place(pin))
      add(fmt::format("has vertex {} where cells would become too narrow, expected a place nearer to {:.1f},{:.1f}",
                      name_of(pin), grid->vertex(pin.column, pin.row).x * mm_per_px,
                      grid->vertex(pin.column, pin.row).y * mm_per_px),
          problems);
  if (auto good = failed(problems); !good) return tl::unexpected(good.error());
  return patches_of_cells(cells_of(*grid, edges, params, mm_per_px), target.size(), target_index);
}

}  // namespace tessera::parquetry
