#include "tessera/parquetry/spacing.h"

#include <algorithm>
#include <limits>

namespace tessera::parquetry {
namespace {

constexpr double kLeast = 1e-6;  // what is nearer touches: sides that lie on each other cross nowhere

double squared_distance(Point p, Point a, Point b) {
  const Point side = b - a, off = p - a;
  const double along = dot(side, side);
  const double t = along > 0 ? std::clamp(dot(off, side) / along, 0.0, 1.0) : 0;
  const Point rest = off - t * side;
  return dot(rest, rest);
}

template <class Visit>
void each_side(const Ring& ring, const Visit& visit) {
  for (std::size_t i = 0, last = ring.size() - 1; i < ring.size(); last = i++) visit(ring[last], ring[i]);
}

bool is_beside(Point a, Point b, const Bounds& box) {
  return std::max(a.x, b.x) < box.low.x || std::min(a.x, b.x) > box.high.x || std::max(a.y, b.y) < box.low.y ||
         std::min(a.y, b.y) > box.high.y;
}

bool cross_each_other(Point a, Point b, Point c, Point d) {
  const auto side = [](Point p, Point q, Point r) { return cross(q - p, r - p); };
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

double squared_distance_to_sides(const Ring& ring, Point p) {
  double least = std::numeric_limits<double>::infinity();
  each_side(ring, [&](Point a, Point b) { least = std::min(least, squared_distance(p, a, b)); });
  return least;
}

// `box`: of the ring; only vertices within `distance` of it matter.
bool vertices_are_apart(const Ring& from, const Ring& ring, const Bounds& box, double distance) {
  return std::all_of(from.begin(), from.end(), [&](Point p) {
    return p.x <= box.low.x - distance || p.x >= box.high.x + distance || p.y <= box.low.y - distance ||
           p.y >= box.high.y + distance || squared_distance_to_sides(ring, p) >= distance * distance;
  });
}

}  // namespace

bool contains(const Ring& ring, Point p) {
  bool inside = false;
  each_side(ring, [&](Point a, Point b) {
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  });
  return inside;
}

double distance_to_sides(const Ring& ring, Point p) { return std::sqrt(squared_distance_to_sides(ring, p)); }

double distance(const Ring& ring, Point p) { return contains(ring, p) ? 0 : distance_to_sides(ring, p); }

bool are_apart(const Ring& a, const Ring& b, double distance) {
  distance = std::max(distance, kLeast);
  const Bounds s = bounds_of(a), t = bounds_of(b);
  const double across = std::max(s.low.x - t.high.x, t.low.x - s.high.x);
  const double down = std::max(s.low.y - t.high.y, t.low.y - s.high.y);
  if (std::max(across, down) >= distance) return true;
  // The nearest points of two that do not meet are a vertex of one and a point on a side of the other.
  if (!vertices_are_apart(a, b, t, distance) || !vertices_are_apart(b, a, s, distance)) return false;
  if (contains(a, b.front()) || contains(b, a.front())) return false;
  bool crossing = false;
  each_side(a, [&](Point p, Point q) {
    if (crossing || is_beside(p, q, t)) return;
    each_side(b, [&](Point r, Point u) { crossing = crossing || cross_each_other(p, q, r, u); });
  });
  return !crossing;
}

}  // namespace tessera::parquetry
