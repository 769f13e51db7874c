#include "tessera/parquetry/live_grid.h"

#include <algorithm>
#include <utility>

#include "tessera/parquetry/morphed_patches.h"
#include "tessera/parquetry/patches.h"

namespace tessera::parquetry {
namespace {

bool are_equal(const cv::Mat3b& a, const cv::Mat3b& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
}

}  // namespace

LiveGrid::LiveGrid(cv::Mat3b target, const Params& params, double mm_per_px)
    : target_(std::move(target)),
      mm_per_px_(mm_per_px),
      found_(edges_of(target_, grid_of(target_.size(), params, mm_per_px))),
      params_(params) {}

bool LiveGrid::is_of(const cv::Mat3b& target, const Params& params, double mm_per_px) const {
  return mm_per_px == mm_per_px_ && are_equal(target, target_) &&
         grid_of(target.size(), params, mm_per_px) == grid_of(target.size(), params_, mm_per_px);
}

Result<void> LiveGrid::begin(const Params& params, const EdgeMasks& masks) {
  const Params old_params = std::exchange(params_, params);
  const FoundEdges old_counting = std::exchange(counting_, masked(found_, masks));
  auto begun = restart();
  if (!begun) params_ = old_params, counting_ = old_counting;
  return begun;
}

Result<void> LiveGrid::restart() {
  auto edges = std::make_unique<const EdgePicture>(edge_picture_of(counting_, target_.size(), params_, mm_per_px_));
  auto grid = morphing_grid_of(target_.size(), *edges, params_, mm_per_px_);
  if (!grid) return tl::unexpected(grid.error());
  grid_.emplace(*std::move(grid));
  edges_ = std::move(edges);
  dragged_.reset();
  return {};
}

int LiveGrid::step(int most) {
  int steps = 0;
  for (; steps < most && !grid_->is_at_rest(); ++steps) grid_->step();
  return steps;
}

std::vector<Point> LiveGrid::vertices() const {
  std::vector<Point> vertices;
  for (int row = 0; row <= grid_->down(); ++row)
    for (int column = 0; column <= grid_->across(); ++column) vertices.push_back(grid_->vertex(column, row));
  return vertices;
}

void LiveGrid::drag(int column, int row, Point mm) {
  if (!dragged_ || dragged_->column != column || dragged_->row != row) dragged_ = {column, row, vertices()};
  grid_->pin({column, row, (1 / mm_per_px_) * mm});
}

std::string LiveGrid::lay() {
  if (!dragged_) return params_.pins;
  const Dragged laid = *std::exchange(dragged_, std::nullopt);
  const std::string old_pins = params_.pins;
  std::vector<Pin> pins = read_pins(old_pins);
  std::erase_if(pins, [&](const Pin& pin) { return pin.column == laid.column && pin.row == laid.row; });
  pins.push_back({laid.column, laid.row, mm_per_px_ * grid_->vertex(laid.column, laid.row)});
  if (!hold(std::move(pins), laid.before)) {
    params_.pins = old_pins;
    if (restart()) grid_->settle();
  }
  return params_.pins;
}

// Makes the grid with these pins; those which are out of reach come back a little more each time.
bool LiveGrid::hold(std::vector<Pin> pins, const std::vector<Point>& before) {
  constexpr int kRounds = 5;
  for (int round = 1; round <= kRounds; ++round) {
    params_.pins = write_pins(pins);
    if (!restart()) return false;
    grid_->settle();
    bool all = true;
    for (const Pin& held : grid_->pins()) {
      if (grid_->is_in_place(held)) continue;
      all = false;
      const Point reached = grid_->vertex(held.column, held.row);
      const Point back = before[held.row * (grid_->across() + 1) + held.column] - reached;
      for (Pin& pin : pins)
        if (pin.column == held.column && pin.row == held.row) pin.at = mm_per_px_ * (reached + (0.2 * round) * back);
    }
    if (all) return true;
  }
  return false;
}

}  // namespace tessera::parquetry
