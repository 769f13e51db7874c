#include "tessera/statistics/cells.h"

#include <algorithm>
#include <cmath>

#include "tessera/geometry/scan.h"

namespace tessera::statistics {
namespace {

// A side ends where the outline turns by more than a tenth of a degree.
int sides_of(const Ring& ring) {
  constexpr double kSine = 0.00175;
  int corners = 0;
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point in = ring[i] - ring[i > 0 ? i - 1 : n - 1], out = ring[i + 1 < n ? i + 1 : 0] - ring[i];
    if (std::abs(cross(in, out)) > kSine * length(in) * length(out)) ++corners;
  }
  return corners;
}

Moment moment_of(const std::vector<Weighted>& values) {
  Moment m;
  double sum = 0, squares = 0;
  for (const auto& [value, weight] : values) sum += weight, squares += weight * weight, m.mean += weight * value;
  if (sum <= 0) return m;
  m.mean /= sum;
  for (const auto& [value, weight] : values) m.variance += weight * (value - m.mean) * (value - m.mean) / sum;
  m.error = std::sqrt(m.variance * squares) / sum;
  return m;
}

}  // namespace

CellStatistics cell_statistics(const std::vector<Ring>& cells, const Window& window) {
  CellStatistics s;
  s.cells = static_cast<int>(cells.size());
  const Point size = window.size();
  const double touch = 1e-6 * std::max(size.x, size.y);
  std::vector<Weighted> perimeters, sides;
  for (const Ring& ring : cells) {
    const auto [low, high] = bounds_of(ring);
    const bool cut = low.x <= window.low.x + touch || low.y <= window.low.y + touch ||
                     high.x >= window.high.x - touch || high.y >= window.high.y - touch;
    if (cut) continue;
    ++s.inner;
    const double weight = 1 / ((size.x - (high.x - low.x)) * (size.y - (high.y - low.y)));
    const int corners = sides_of(ring);
    s.areas.push_back({std::abs(signed_area(ring)), weight});
    perimeters.push_back({perimeter(ring), weight});
    sides.push_back({static_cast<double>(corners), weight});
    s.per_area += weight;
    if (static_cast<std::size_t>(corners) >= s.side_shares.size()) s.side_shares.resize(corners + 1, 0);
    s.side_shares[corners] += weight;
  }
  for (double& share : s.side_shares) share /= s.per_area;
  s.area = moment_of(s.areas);
  s.perimeter = moment_of(perimeters);
  s.sides = moment_of(sides);
  std::stable_sort(s.areas.begin(), s.areas.end(), [](auto a, auto b) { return a.value < b.value; });
  return s;
}

cv::Mat1i draw_cells(const std::vector<Ring>& cells, const Window& window, double size) {
  const auto pixels = [&](double length) { return std::max(1, static_cast<int>(std::ceil(length / size))); };
  cv::Mat1i drawn(pixels(window.size().y), pixels(window.size().x), -1);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    Ring ring = cells[k];
    for (Point& p : ring) p = (1 / size) * (p - window.low);
    each_run(ring, drawn.cols, drawn.rows, [&](int y, int begin, int end) {
      std::fill(drawn.ptr<int>(y) + begin, drawn.ptr<int>(y) + end, static_cast<int>(k));
    });
  }
  return drawn;
}

}  // namespace tessera::statistics
