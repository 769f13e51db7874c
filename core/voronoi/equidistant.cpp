#include "tessera/voronoi/equidistant.h"

#include <cmath>

namespace tessera {

bool make_equidistant(const SiteDistance& a, const SiteDistance& b, const SiteDistance& c, double limit, Point& p) {
  Point q = p;
  double last = 0;  // how far the last step went
  for (int i = 0; i < 6; ++i) {
    const auto u = a.at(q.x, q.y), v = b.at(q.x, q.y), w = c.at(q.x, q.y);
    const Point uv{u.slope_x - v.slope_x, u.slope_y - v.slope_y}, uw{u.slope_x - w.slope_x, u.slope_y - w.slope_y};
    const double f = u.distance - v.distance, g = u.distance - w.distance, det = cross(uv, uw);
    // Bisectors that meet at a small angle say little about where.
    if (std::fabs(det) <= 0.05 * length({u.slope_x, u.slope_y}) * length({w.slope_x, w.slope_y})) return false;
    const Point step{(g * uv.y - f * uw.y) / det, (f * uw.x - g * uv.x) / det};
    q += step;
    if (length(q - p) > limit) return false;
    last = length(step);
    if (last < 1e-3) break;
  }
  if (last > 0.05) return false;
  p = q;
  return true;
}

bool make_equidistant_along(const SiteDistance& a, const SiteDistance& b, Point direction, double limit, Point& p) {
  Point q = p;
  for (int i = 0; i < 4; ++i) {
    const auto u = a.at(q.x, q.y), v = b.at(q.x, q.y);
    const double slope = dot({u.slope_x - v.slope_x, u.slope_y - v.slope_y}, direction);
    if (std::fabs(slope) <= 0.1 * length({u.slope_x, u.slope_y})) return false;
    q -= ((u.distance - v.distance) / slope) * direction;
    if (length(q - p) > limit) return false;
  }
  p = q;
  return true;
}

}  // namespace tessera
