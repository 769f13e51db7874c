#include "tessera/statistics/points.h"

#include <algorithm>
#include <cmath>

#include "tessera/base/portable_math.h"
#include "tessera/points/point_grid.h"

namespace tessera::statistics {
namespace {

// pairs[r * bins + b]: neighbours between radii b - 1 and b of points whose distance to the border is between r and
// r + 1, counted from radii 0 = 0; inner[r] such points.
struct Counts {
  std::vector<double> pairs, inner;
};

Counts count_pairs(const std::vector<Point>& points, const Window& window, const std::vector<double>& radii) {
  const std::size_t n = radii.size();
  Counts counts{std::vector<double>((n + 1) * n, 0), std::vector<double>(n + 1, 0)};
  const PointGrid grid(points, window, radii.back() / 2);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point low = points[i] - window.low, high = window.high - points[i];
    const double border = std::min({low.x, low.y, high.x, high.y});
    const auto room =
        window.periodic
            ? n
            : static_cast<std::size_t>(std::upper_bound(radii.begin(), radii.end(), border) - radii.begin());
    counts.inner[room] += 1;
    if (room == 0) continue;
    grid.each_near(points[i], radii[room - 1], [&](int k, Point place) {
      if (k == static_cast<int>(i) && place == points[i]) return true;
      const double away = length(place - points[i]);
      const auto bin = std::lower_bound(radii.begin(), radii.end(), away) - radii.begin();
      counts.pairs[room * n + static_cast<std::size_t>(bin)] += 1;
      return true;
    });
  }
  return counts;
}

double mean_nearest(const std::vector<Point>& points, const Window& window) {
  if (points.size() < 2) return 0;
  const double size = std::max(window.size().x, window.size().y);
  const double share = std::sqrt(window.area() / static_cast<double>(points.size()));
  const PointGrid grid(points, window, share);
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    double least = -1;
    for (double reach = share; least < 0 && reach < 4 * size; reach *= 2)
      grid.each_near(points[i], reach, [&](int k, Point place) {
        const double away = length(place - points[i]);
        if (k != static_cast<int>(i) && (least < 0 || away < least)) least = away;
        return true;
      });
    sum += std::max(0.0, least);
  }
  return sum / static_cast<double>(points.size());
}

}  // namespace

PointStatistics point_statistics(const std::vector<Point>& points, const Window& window,
                                 const std::vector<double>& radii) {
  PointStatistics s;
  s.radii = radii;
  s.k.assign(radii.size(), 0);
  s.pair_correlation.assign(radii.size(), 0);
  if (points.empty() || window.area() <= 0 || radii.empty()) return s;
  s.intensity = static_cast<double>(points.size()) / window.area();
  s.nearest = mean_nearest(points, window);
  const Counts counts = count_pairs(points, window, radii);
  const std::size_t n = radii.size();
  // Points at least radii[b] from the border see all of the disc: those of rooms above b (reduced sample).
  for (std::size_t b = 0; b < n; ++b) {
    double pairs = 0, ring = 0, inner = 0;
    for (std::size_t room = b + 1; room <= n; ++room) {
      inner += counts.inner[room];
      for (std::size_t k = 0; k <= b; ++k) pairs += counts.pairs[room * n + k];
      ring += counts.pairs[room * n + b];
    }
    if (inner == 0) continue;
    const double before = b > 0 ? radii[b - 1] : 0;
    s.k[b] = pairs / inner / s.intensity;
    s.pair_correlation[b] = ring / inner / s.intensity / (kPi * (radii[b] * radii[b] - before * before));
  }
  return s;
}

}  // namespace tessera::statistics
