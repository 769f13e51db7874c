#include "tessera/points/point_grid.h"

namespace tessera {

PointGrid::PointGrid(const std::vector<Point>& points, const Window& window, double reach)
    : points_(points), window_(window) {
  // No more cells than points, or so: a small reach would make a grid of nothing.
  const double most = std::sqrt(static_cast<double>(points.size()) + 1);
  const auto cells = [&](double size, double other) {
    const double wanted = std::min(size / reach, 2 * most * std::sqrt(size / std::max(other, size * 1e-6)));
    return static_cast<int>(std::clamp(std::floor(wanted), 1.0, 1e6));
  };
  const Point size = window.size();
  columns_ = cells(size.x, size.y);
  rows_ = cells(size.y, size.x);
  scale_ = {columns_ / size.x, rows_ / size.y};

  std::vector<int> cell_of(points.size());
  first_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int column = std::clamp(column_of(points[i].x), 0, columns_ - 1);
    const int row = std::clamp(row_of(points[i].y), 0, rows_ - 1);
    cell_of[i] = row * columns_ + column;
    ++first_[cell_of[i] + 1];
  }
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  order_.resize(points.size());
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < points.size(); ++i) order_[next[cell_of[i]]++] = static_cast<int>(i);
}

}  // namespace tessera
