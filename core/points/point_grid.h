// Points by place: which are near?
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tessera/points/window.h"

namespace tessera {

// A grid of square cells over a window, with the points in it; memory and time to build are linear. The points are
// somebody else's and stay as they are while the grid lives.
class PointGrid {
 public:
  // `reach` > 0: about the radius that will be asked for. Points outside of the window count to the cells at its
  // border.
  PointGrid(const std::vector<Point>& points, const Window& window, double reach);

  // Calls visit(i, place) for points with |place - p| <= radius, in no particular order, until it returns false; then
  // returns false, too. In a periodic window `place` may lie outside of it, and a point may come in several places.
  template <class Visit>
  bool each_near(Point p, double radius, Visit&& visit) const;

 private:
  int column_of(double x) const { return static_cast<int>(std::floor((x - window_.low.x) * scale_.x)); }
  int row_of(double y) const { return static_cast<int>(std::floor((y - window_.low.y) * scale_.y)); }
  // A cell beyond the end of a periodic window is one of another turn.
  static std::pair<int, int> wrapped(int cell, int count) {
    const int turn = static_cast<int>(std::floor(static_cast<double>(cell) / count));
    return {cell - turn * count, turn};
  }

  const std::vector<Point>& points_;
  Window window_;
  int columns_ = 1, rows_ = 1;
  Point scale_;             // cells a unit of length
  std::vector<int> first_;  // of a cell in order_; one more at the end
  std::vector<int> order_;
};

template <class Visit>
bool PointGrid::each_near(Point p, double radius, Visit&& visit) const {
  const auto range = [&](int low, int high, int count) {
    return window_.periodic ? std::pair{low, high}
                            : std::pair{std::clamp(low, 0, count - 1), std::clamp(high, 0, count - 1)};
  };
  const auto [left, right] = range(column_of(p.x - radius), column_of(p.x + radius), columns_);
  const auto [top, bottom] = range(row_of(p.y - radius), row_of(p.y + radius), rows_);
  for (int j = top; j <= bottom; ++j) {
    const auto [row, turn_y] = wrapped(j, rows_);
    for (int i = left; i <= right; ++i) {
      const auto [column, turn_x] = wrapped(i, columns_);
      const Point shift{turn_x * window_.size().x, turn_y * window_.size().y};
      const int cell = row * columns_ + column;
      for (int k = first_[cell]; k < first_[cell + 1]; ++k) {
        const Point place = points_[order_[k]] + shift, way = place - p;
        if (dot(way, way) <= radius * radius && !visit(order_[k], place)) return false;
      }
    }
  }
  return true;
}

}  // namespace tessera
