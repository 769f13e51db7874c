#include "tessera/patterns/voronoi_cells.h"

#include <algorithm>
#include <array>
#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "tessera/base/portable_math.h"

namespace tessera::patterns {
namespace {

using Diagram = boost::polygon::voronoi_diagram<double>;
using GridPoint = boost::polygon::point_data<std::int32_t>;

constexpr double kHalfGrid = 1 << 29;  // the library's coordinates are 32-bit numbers

// Where the library's whole numbers lie: enough of them around all that there is for guards far away. The size of a
// periodic window is a whole number of them.
class Grid {
 public:
  Grid(const Window& window, Point low, Point high) : centre_(0.5 * (low + high)), reach_(2.5 * length(high - low)) {
    const double scale = kHalfGrid / reach_;
    const auto fitting = [&](double period) { return window.periodic ? std::round(period * scale) / period : scale; };
    scale_ = {fitting(window.size().x), fitting(window.size().y)};
  }

  GridPoint number(Point p) const {
    const auto whole = [](double v) { return static_cast<std::int32_t>(std::lround(v)); };
    return {whole((p.x - centre_.x) * scale_.x), whole((p.y - centre_.y) * scale_.y)};
  }
  // Rounded, so that diagrams which know of different points have the same vertices where they have the same cells.
  Point place(double x, double y) const {
    constexpr double kParts = 64;
    return {std::round(x * kParts) / kParts / scale_.x + centre_.x,
            std::round(y * kParts) / kParts / scale_.y + centre_.y};
  }
  // So far away that all cells near the window are bounded, and none of these has any of it.
  std::array<Point, 4> guards() const {
    return {centre_ + Point{reach_, 0}, centre_ - Point{reach_, 0}, centre_ + Point{0, reach_},
            centre_ - Point{0, reach_}};
  }

 private:
  Point centre_;
  double reach_;
  Point scale_;
};

// The library's diagram of points, and of the guards.
class Sites {
 public:
  Sites(const std::vector<Point>& points, const Grid& grid) : grid_(grid), own_(points.size()) {
    numbers_.reserve(own_ + 4);
    for (const Point p : points) numbers_.push_back(grid.number(p));
    for (const Point p : grid.guards()) numbers_.push_back(grid.number(p));
    boost::polygon::construct_voronoi(numbers_.begin(), numbers_.end(), &diagram_);
  }

  const Diagram& diagram() const { return diagram_; }
  bool is_guard(std::size_t index) const { return index >= own_; }
  Point site(std::size_t index) const { return grid_.place(numbers_[index].x(), numbers_[index].y()); }
  Point place(const Diagram::vertex_type& vertex) const { return grid_.place(vertex.x(), vertex.y()); }

 private:
  const Grid& grid_;
  std::size_t own_;
  std::vector<GridPoint> numbers_;
  Diagram diagram_;
};

Grid grid_of(const std::vector<Point>& points, const Window& window) {
  Point low = window.low, high = window.high;
  for (const Point p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return {window, low, high};
}

// The points of a periodic window, on the grid, and their copies that are no farther from it than `margin`.
std::vector<Point> with_copies(const std::vector<Point>& points, const Window& window, double margin,
                               const Grid& grid) {
  std::vector<Point> all;
  for (const Point p : points) all.push_back(grid.place(grid.number(p).x(), grid.number(p).y()));
  const Window realm = window.grown(margin);
  const Point size = window.size();
  const int across = static_cast<int>(std::ceil(margin / size.x));
  const int down = static_cast<int>(std::ceil(margin / size.y));
  for (int j = -down; j <= down; ++j)
    for (int i = -across; i <= across; ++i) {
      if (i == 0 && j == 0) continue;
      for (std::size_t k = 0; k < points.size(); ++k)
        if (const Point copy = all[k] + Point{i * size.x, j * size.y}; realm.holds(copy)) all.push_back(copy);
    }
  return all;
}

// Whether copies beyond the margin could lie in the disc about a vertex, on whose rim its sites are.
bool reaches_beyond(const Window& window, double margin, Point vertex, Point site) {
  const double radius = length(vertex - site);
  const Point least = vertex - Point{radius, radius}, most = vertex + Point{radius, radius};
  const Window realm = window.grown(margin);
  return !realm.holds(least) || !realm.holds(most);
}

Ring oriented(Ring ring) {
  if (signed_area(ring) < 0) std::reverse(ring.begin(), ring.end());
  return ring;
}

// What is asked of one diagram: the cells whose points, or the triangles whose centres, lie in `part` of the window.
struct Task {
  const Window& window;
  Window part;
  double margin;  // of a periodic window: how far from it copies are known
};

// Appends the cells, those of a periodic window as they are; false where the margin was too small.
bool append_voronoi(const Sites& sites, const Task& task, Cells& cells) {
  Ring ring;
  for (const auto& cell : sites.diagram().cells()) {
    const Point site = sites.site(cell.source_index());
    if (sites.is_guard(cell.source_index()) || !task.part.holds(site)) continue;
    ring.clear();
    const auto* edge = cell.incident_edge();
    do {
      ring.push_back(sites.place(*edge->vertex0()));  // only guards' cells are open
      if (task.window.periodic && reaches_beyond(task.window, task.margin, ring.back(), site)) return false;
      edge = edge->next();
    } while (edge != cell.incident_edge());
    if (task.window.periodic)
      cells.push_back(ring);
    else
      append_within(task.window, ring, cells);
  }
  return true;
}

bool append_delaunay(const Sites& sites, const Task& task, Cells& cells) {
  Ring around;
  for (const auto& vertex : sites.diagram().vertices()) {
    // The points about a vertex; more than three where they lie on one circle.
    around.clear();
    bool whole = true;
    const auto* edge = vertex.incident_edge();
    do {
      whole = whole && !sites.is_guard(edge->cell()->source_index());
      around.push_back(sites.site(edge->cell()->source_index()));
      edge = edge->rot_next();
    } while (edge != vertex.incident_edge());
    for (std::size_t k = 1; whole && k + 1 < around.size(); ++k) {
      Ring triangle = oriented({around[0], around[k], around[k + 1]});
      if (!task.part.holds(centroid(triangle))) continue;
      if (!task.window.periodic) {
        append_within(task.window, std::move(triangle), cells);
      } else {
        if (reaches_beyond(task.window, task.margin, sites.place(vertex), around[0])) return false;
        cells.push_back(std::move(triangle));
      }
    }
  }
  return true;
}

// Parts of the window, those at its border without an end, of about so many points each that a diagram of them stays
// in the processor's cache.
std::vector<Window> parts_of(const Window& window, std::size_t points) {
  constexpr double kEndless = 1e300, kPointsAPart = 50000;
  const int count = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(points) / kPointsAPart)), 1, 64);
  const auto limit = [&](int k, double low, double high) {
    return k == 0 ? -kEndless : k == count ? kEndless : low + (high - low) * k / count;
  };
  std::vector<Window> parts;
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < count; ++i)
      parts.push_back({{limit(i, window.low.x, window.high.x), limit(j, window.low.y, window.high.y)},
                       {limit(i + 1, window.low.x, window.high.x), limit(j + 1, window.low.y, window.high.y)}});
  return parts;
}

template <class Append>
Cells cells_of(const std::vector<Point>& points, const Window& window, double reach, const Append& append) {
  Cells cells;
  if (points.empty() || window.area() <= 0) return cells;
  if (!window.periodic) {
    const Grid grid = grid_of(points, window);
    for (const Window& part : reach > 0 ? parts_of(window, points.size()) : parts_of(window, 1)) {
      const Window realm = part.grown(reach);
      std::vector<Point> near;
      std::copy_if(points.begin(), points.end(), std::back_inserter(near), [&](Point p) { return realm.holds(p); });
      if (!near.empty()) append(Sites(near, grid), {window, part, 0}, cells);
    }
    return cells;
  }
  // Copies are needed as far as the largest empty disc reaches, which is not known before.
  double margin = 4 * std::sqrt(window.area() / static_cast<double>(points.size()));
  for (;; margin *= 2) {
    const Window realm = window.grown(margin);
    const Grid grid(window, realm.low, realm.high);
    if (append(Sites(with_copies(points, window, margin, grid), grid), {window, window, margin}, cells)) break;
    cells.clear();
  }
  return cells;
}

}  // namespace

double voronoi_reach(double intensity) {
  // A disc of that radius without a point has the chance exp(-35).
  return intensity > 0 ? std::sqrt(35 / (kPi * intensity)) : 0;
}

Cells voronoi_cells(const std::vector<Point>& points, const Window& window, double reach) {
  return cells_of(points, window, reach, append_voronoi);
}

Cells delaunay_cells(const std::vector<Point>& points, const Window& window, double reach) {
  return cells_of(points, window, 2 * reach, append_delaunay);
}

}  // namespace tessera::patterns
