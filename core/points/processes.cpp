#include "tessera/points/processes.h"

#include <algorithm>
#include <cmath>

#include "tessera/base/distributions.h"
#include "tessera/base/portable_math.h"
#include "tessera/points/point_grid.h"

namespace tessera {
namespace {

constexpr double kSpreads = 6;  // farther from its parent no child falls
constexpr int kTries = 30;      // Bridson's k

Point place_in(const Window& window, Rng& rng) {
  const double x = rng.uniform(window.low.x, window.high.x);
  return {x, rng.uniform(window.low.y, window.high.y)};
}

// What of a realization on a larger window, or on the same one where it is periodic, lies in the window.
std::vector<Point> within(const Window& window, std::vector<Point> points) {
  std::erase_if(points, [&](Point p) { return !window.holds(p); });
  return points;
}

Window with_surroundings(const Window& window, double reach) {
  return window.periodic ? window : window.grown(reach);
}

// The points that no other one within 2d drives away: rival(i, k) says whether k does that to i.
template <class Rival>
std::vector<Point> inhibited(const Window& window, const Window& realm, const std::vector<Point>& points, double d,
                             Rival&& rival) {
  std::vector<Point> kept;
  const PointGrid grid(points, realm, 2 * d);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!window.holds(points[i])) continue;
    const auto leaves_it = [&](int k, Point place) { return place == points[i] || !rival(static_cast<int>(i), k); };
    if (grid.each_near(points[i], 2 * d, leaves_it)) kept.push_back(points[i]);
  }
  return kept;
}

// Bridson's grid: cells so small that each holds a point at most.
class SparseGrid {
 public:
  SparseGrid(const Window& window, double distance)
      : window_(window),
        distance_(distance),
        columns_(cells(window.size().x)),
        rows_(cells(window.size().y)),
        taken_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), -1) {}

  bool has_room(Point p, const std::vector<Point>& points) const {
    constexpr int kReach = 3;  // cells; a side may be as short as distance / 2
    const int column = column_of(p), row = row_of(p);
    for (int j = row - kReach; j <= row + kReach; ++j)
      for (int i = column - kReach; i <= column + kReach; ++i) {
        const int c = inside(i, columns_), r = inside(j, rows_);
        const int other = c < 0 || r < 0 ? -1 : taken_[static_cast<std::size_t>(r) * columns_ + c];
        if (other >= 0 && is_near(p, points[other])) return false;
      }
    return true;
  }

  void take(Point p, int index) { taken_[static_cast<std::size_t>(row_of(p)) * columns_ + column_of(p)] = index; }

 private:
  int cells(double size) const { return std::max(1, static_cast<int>(std::ceil(size / distance_ * std::sqrt(2.0)))); }
  int column_of(Point p) const { return cell_of(p.x - window_.low.x, window_.size().x, columns_); }
  int row_of(Point p) const { return cell_of(p.y - window_.low.y, window_.size().y, rows_); }
  static int cell_of(double v, double size, int count) {
    return std::clamp(static_cast<int>(v / size * count), 0, count - 1);
  }
  int inside(int cell, int count) const {
    if (window_.periodic) return (cell % count + count) % count;
    return cell < count ? cell : -1;
  }
  bool is_near(Point p, Point q) const {
    Point way = p - q;
    if (window_.periodic) {
      const Point size = window_.size();
      way -= Point{size.x * std::round(way.x / size.x), size.y * std::round(way.y / size.y)};
    }
    return dot(way, way) < distance_ * distance_;
  }

  Window window_;
  double distance_;
  int columns_, rows_;
  std::vector<int> taken_;
};

}  // namespace

std::vector<Point> poisson_points(const Window& window, double intensity, Rng& rng) {
  std::vector<Point> points(static_cast<std::size_t>(draw_poisson(intensity * window.area(), rng)));
  for (Point& p : points) p = place_in(window, rng);
  return points;
}

std::vector<Point> binomial_points(const Window& window, double intensity, double spacing, Rng& rng) {
  const double chance = 1 - std::exp(-intensity * spacing * spacing);
  std::vector<Point> points;
  if (chance <= 0) return points;
  for (double y = window.low.y + spacing / 2; y < window.high.y; y += spacing)
    for (double x = window.low.x + spacing / 2; x < window.high.x; x += spacing)
      if (rng.uniform() < chance) points.push_back({x, y});
  return points;
}

std::vector<Point> cluster_points(const Window& window, double parents, double family, double spread, Rng& rng) {
  std::vector<Point> points;
  for (const Point parent : poisson_points(with_surroundings(window, kSpreads * spread), parents, rng))
    for (std::int64_t n = draw_poisson(family, rng); n > 0; --n) {
      const double x = parent.x + spread * draw_normal(rng), y = parent.y + spread * draw_normal(rng);
      points.push_back(window.periodic ? window.wrapped({x, y}) : Point{x, y});
    }
  return within(window, std::move(points));
}

std::vector<Point> matern1_points(const Window& window, double alpha, double d, Rng& rng) {
  const Window realm = with_surroundings(window, 2 * d);
  std::vector<Point> points = poisson_points(realm, alpha, rng);
  if (d <= 0) return points;
  return inhibited(window, realm, points, d, [](int, int) { return true; });
}

std::vector<Point> matern2_points(const Window& window, double alpha, double d, Rng& rng) {
  const Window realm = with_surroundings(window, 2 * d);
  std::vector<Point> points = poisson_points(realm, alpha, rng);  // in the order in which they come
  if (d <= 0) return points;
  return inhibited(window, realm, points, d, [](int i, int k) { return k < i; });
}

std::vector<Point> mixed_points(const Window& window, double intensity, double variation, Rng& rng) {
  const double drawn = variation > 0 ? draw_gamma(1 / (variation * variation), rng) : 1;
  return poisson_points(window, intensity * drawn, rng);
}

std::vector<Point> density_points(const Window& window, double intensity, const Density& density, Rng& rng) {
  const double largest = density.largest();
  std::vector<Point> points = poisson_points(window, intensity * largest, rng);
  std::erase_if(points, [&](Point p) { return rng.uniform() * largest >= density.at(p); });
  return points;
}

std::vector<Point> blue_noise_points(const Window& window, double distance, Rng& rng) {
  SparseGrid grid(window, distance);
  std::vector<Point> points{place_in(window, rng)};
  std::vector<int> active{0};
  grid.take(points[0], 0);
  while (!active.empty()) {
    const auto pick = std::min(active.size() - 1, static_cast<std::size_t>(rng.uniform() * active.size()));
    const Point from = points[active[pick]];
    bool found = false;
    for (int t = 0; t < kTries && !found; ++t) {
      // Uniform in the ring between the distance and twice of it.
      const double away = distance * std::sqrt(rng.uniform(1, 4));
      const SinCos turn = sin_cos(rng.uniform(0, 2 * kPi));
      Point p = from + away * Point{turn.cos, turn.sin};
      if (window.periodic) p = window.wrapped(p);
      found = window.holds(p) && grid.has_room(p, points);
      if (!found) continue;
      grid.take(p, static_cast<int>(points.size()));
      active.push_back(static_cast<int>(points.size()));
      points.push_back(p);
    }
    if (!found) {
      active[pick] = active.back();
      active.pop_back();
    }
  }
  return points;
}

}  // namespace tessera
