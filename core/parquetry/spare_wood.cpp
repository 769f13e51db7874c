#include "tessera/parquetry/spare_wood.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "tessera/parquetry/wood.h"

namespace tessera::parquetry {

SpareWood::SpareWood(const std::vector<Panel>& panels, const std::vector<Patch>& patches,
                     const std::vector<Placement>& placements, double apart, double inside)
    : patches_(patches), apart_(apart), inside_(inside) {
  assert(patches.size() == placements.size());
  for (const Panel& panel : panels) depths_.push_back(depth_of(panel.mask));
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const double width = patches[i].box.width, height = patches[i].box.height;
    cells_.push_back({.panel = placements[i].panel,
                      .middle = placements[i].to,
                      .angle = Angle::of_degrees(placements[i].turn_deg),
                      .width = width,
                      .height = height,
                      .reach = 0.5 * std::sqrt(width * width + height * height)});
  }
}

Point SpareWood::Cell::on_panel(Point off) const { return middle + angle.turned_back(off); }

double SpareWood::Cell::distance(Point on_panel) const {
  const Point off = angle.turned(on_panel - middle);
  return length({std::max(0.0, std::abs(off.x) - 0.5 * width), std::max(0.0, std::abs(off.y) - 0.5 * height)});
}

std::vector<const SpareWood::Cell*> SpareWood::near(const Cell& cell, double reach) const {
  std::vector<const Cell*> found;
  for (const Cell& other : cells_)
    if (&other != &cell && other.panel == cell.panel && length(other.middle - cell.middle) < reach + other.reach)
      found.push_back(&other);
  return found;
}

cv::Mat1b SpareWood::around(std::size_t patch, cv::Rect box) const {
  const cv::Rect own = patches_[patch].box;
  cv::Mat1b free(box.size(), static_cast<std::uint8_t>(0));
  free(own - box.tl()).setTo(255);
  const Cell& cell = cells_[patch];
  if (cell.panel < 0) return free;
  const cv::Mat1f& depth = depths_[static_cast<std::size_t>(cell.panel)];
  const double reach = std::max(box.width, box.height);  // more than from the middle to a corner
  const std::vector<const Cell*> others = near(cell, 2 * reach + apart_);
  const Point middle{own.x + 0.5 * own.width, own.y + 0.5 * own.height};
  const auto is_free = [&](Point p) {
    if (p.x < 0 || p.y < 0 || p.x >= depth.cols || p.y >= depth.rows) return false;
    if (depth(static_cast<int>(p.y), static_cast<int>(p.x)) < inside_ + kHalfDiagonal) return false;
    // Distances change by as much as one moves at most: where theirs is `apart` more than this one's, and for a
    // neighbour's place this one's is as much more than the neighbour's, the two are `apart` from each other.
    const double least = cell.distance(p) + apart_;
    return std::all_of(others.begin(), others.end(), [&](const Cell* other) { return other->distance(p) >= least; });
  };
  for (int y = 0; y < box.height; ++y)
    for (int x = 0; x < box.width; ++x)
      if (free(y, x) == 0 && is_free(cell.on_panel(Point{box.x + x + 0.5, box.y + y + 0.5} - middle)))
        free(y, x) = 255;
  return free;
}

}  // namespace tessera::parquetry
