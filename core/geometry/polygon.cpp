#include "tessera/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tessera/base/portable_math.h"

namespace tessera {
namespace {

// Calls visit(a, b) for each side of the closed ring, the one from the last vertex to the first among them.
template <class Visit>
void each_side(const Ring& ring, Visit&& visit) {
  for (std::size_t i = 0; i < ring.size(); ++i) visit(ring[i], ring[i + 1 < ring.size() ? i + 1 : 0]);
}

bool comes_before(Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

// Whether a ring turns the positive way at every vertex, and once around in all.
bool is_hull(const Ring& ring) {
  const std::size_t n = ring.size();
  int returns = 0;  // changes between going right and going left
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = ring[i], b = ring[i + 1 < n ? i + 1 : 0], c = ring[i + 2 < n ? i + 2 : i + 2 - n];
    if (!(cross(b - a, c - b) > 0)) return false;
    if (comes_before(a, b) != comes_before(b, c)) ++returns;
  }
  return returns == 2;
}

// Strictly convex, of positive signed area, starting at the least vertex by (x, y). Andrew's monotone chain, where
// the ring isn't that already.
Ring convex_hull(Ring points) {
  if (points.size() >= 3 && is_hull(points)) {
    std::rotate(points.begin(), std::min_element(points.begin(), points.end(), comes_before), points.end());
    return points;
  }
  std::sort(points.begin(), points.end(), comes_before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  Ring hull;
  const auto add_chain = [&hull](auto first, auto last) {
    const std::size_t start = hull.size();
    for (; first != last; ++first) {
      while (hull.size() >= start + 2 && cross(hull.back() - hull[hull.size() - 2], *first - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(*first);
    }
    hull.pop_back();  // the other chain starts there
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

struct Rectangle {
  Point along;  // unit vector of one side
  double length = 0, width = 0;
};

// The least rectangle by area; it shares a side with the hull, so the hull is turned once between two pairs of
// parallel lines (rotating calipers).
Rectangle least_rectangle(const Ring& hull) {
  const std::size_t n = hull.size();
  const auto next = [n](std::size_t i) { return i + 1 < n ? i + 1 : 0; };
  Rectangle best;
  double best_area = std::numeric_limits<double>::infinity();
  std::size_t front = 0, top = 0, back = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Point side = hull[next(i)] - hull[i];
    const Point along = (1 / length(side)) * side;
    const auto climb = [&](std::size_t k, auto&& height) {
      for (std::size_t steps = 0; steps < n && height(hull[next(k)]) > height(hull[k]); ++steps) k = next(k);
      return k;
    };
    const auto forward = [&](Point p) { return dot(along, p - hull[i]); };
    const auto across = [&](Point p) { return cross(along, p - hull[i]); };
    const auto backward = [&](Point p) { return -dot(along, p - hull[i]); };
    front = climb(i == 0 ? next(i) : front, forward);
    top = climb(i == 0 ? front : top, across);
    back = climb(i == 0 ? top : back, backward);
    const double extent = forward(hull[front]) + backward(hull[back]), height = across(hull[top]);
    if (extent * height < best_area) {
      best_area = extent * height;
      best = {along, extent, height};
    }
  }
  return best;
}

// Sign of the turn a -> b -> c.
int turn(Point a, Point b, Point c) {
  const double t = cross(b - a, c - a);
  return t > 0 ? 1 : t < 0 ? -1 : 0;
}

bool in_box(Point p, Point a, Point b) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

// Whether the segments ab and cd have a point in common.
bool segments_meet(Point a, Point b, Point c, Point d) {
  const int ac = turn(a, b, c), ad = turn(a, b, d), ca = turn(c, d, a), cb = turn(c, d, b);
  if (ac * ad < 0 && ca * cb < 0) return true;
  return (ac == 0 && in_box(c, a, b)) || (ad == 0 && in_box(d, a, b)) || (ca == 0 && in_box(a, c, d)) ||
         (cb == 0 && in_box(b, c, d));
}

// Whether the side b -> c runs back along the side a -> b, or one of them has no length.
bool folds_back(Point a, Point b, Point c) {
  return a == b || b == c || (turn(a, b, c) == 0 && dot(b - a, c - b) < 0);
}

}  // namespace

// Sums are taken relative to the first vertex: small pieces far from the origin keep their digits.
Bounds bounds_of(const Ring& ring) {
  Bounds box{ring.front(), ring.front()};
  for (const Point p : ring) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}

double signed_area(const Ring& ring) {
  double twice = 0;
  each_side(ring, [&](Point a, Point b) { twice += cross(a - ring[0], b - ring[0]); });
  return twice / 2;
}

double area(const Polygon& polygon) {
  double sum = std::abs(signed_area(polygon.outer));
  for (const Ring& hole : polygon.holes) sum -= std::abs(signed_area(hole));
  return std::max(sum, 0.0);
}

double perimeter(const Ring& ring) {
  double sum = 0;
  each_side(ring, [&](Point a, Point b) { sum += length(b - a); });
  return sum;
}

Point centroid(const Ring& ring) {
  if (ring.empty()) return {};
  Point mean, moment;
  double twice = 0, reach = 0;
  each_side(ring, [&](Point a, Point b) {
    const Point u = a - ring[0], v = b - ring[0];
    twice += cross(u, v);
    moment += cross(u, v) * (u + v);
    mean += u;
    reach = std::max(reach, dot(u, u));
  });
  const bool flat = std::abs(twice) <= 1e-12 * reach;
  return ring[0] + (flat ? 1 / static_cast<double>(ring.size()) * mean : 1 / (3 * twice) * moment);
}

Point centroid_with_holes(const Polygon& polygon) {
  double sum = std::abs(signed_area(polygon.outer));
  Point moment = sum * centroid(polygon.outer);
  for (const Ring& hole : polygon.holes) {
    const double own = std::abs(signed_area(hole));
    sum -= own;
    moment -= own * centroid(hole);
  }
  return polygon.holes.empty() ? centroid(polygon.outer) : 1 / sum * moment;
}

bool is_convex(const Ring& ring, double tolerance_sine) {
  const double sense = signed_area(ring) < 0 ? -1 : 1;
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point in = ring[(i + 1) % n] - ring[i], out = ring[(i + 2) % n] - ring[(i + 1) % n];
    if (sense * cross(in, out) < -tolerance_sine * length(in) * length(out)) return false;
  }
  return true;
}

double orientation_deg(const Ring& ring) {
  const Ring hull = convex_hull(ring);
  if (hull.size() < 2) return 0;
  const Rectangle box = least_rectangle(hull);
  const bool square = std::abs(box.length - box.width) <= 1e-9 * box.length;
  const bool crosswise = box.width > box.length && !square;
  const double turn = square ? 90 : 180;  // a square's sides are alike: the direction in [0, 90)
  const Point along = crosswise ? Point{-box.along.y, box.along.x} : box.along;
  double degrees = std::fmod(atan2_portable(along.y, along.x) * (180 / kPi), turn);
  if (degrees < 0) degrees += turn;
  return degrees < turn ? degrees : 0;
}

bool is_simple(const Ring& ring) {
  const std::size_t n = ring.size();
  if (n < 3) return false;
  const auto at = [&](std::size_t i) { return ring[i < n ? i : i - n]; };
  for (std::size_t i = 0; i < n; ++i) {
    if (folds_back(at(i), at(i + 1), at(i + 2))) return false;
    const std::size_t end = i == 0 ? n - 1 : n;  // the first side and the last are neighbours
    for (std::size_t k = i + 2; k < end; ++k)
      if (segments_meet(at(i), at(i + 1), at(k), at(k + 1))) return false;
  }
  return true;
}

Ring inset(const Ring& ring, double distance) {
  const std::size_t n = ring.size();
  if (n < 3 || distance <= 0) return ring;
  const auto moved = [&](double by) {
    Ring result;
    for (std::size_t i = 0; i < n; ++i) {
      const Point p = ring[i], in = p - ring[i > 0 ? i - 1 : n - 1], out = ring[i + 1 < n ? i + 1 : 0] - p;
      const double a = length(in), b = length(out);
      if (a == 0 || b == 0) return Ring{};
      const Point normal_in{-in.y / a, in.x / a}, normal_out{-out.y / b, out.x / b};
      const double along = 1 + dot(normal_in, normal_out);
      if (along < 0.05) return Ring{};  // a spike
      result.push_back(p + (by / along) * (normal_in + normal_out));
    }
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t k = i + 1 < n ? i + 1 : 0;
      if (dot(result[k] - result[i], ring[k] - ring[i]) <= 0) return Ring{};  // a side has turned over
    }
    return signed_area(result) > 0 && is_simple(result) ? result : Ring{};
  };
  for (const double share : {1.0, 0.5, 0.25, 0.125})
    if (Ring result = moved(share * distance); !result.empty()) return result;
  return ring;
}

Ring clip_convex(const Ring& window, const Ring& ring) {
  Ring rest = ring;
  for (std::size_t i = 0; i < window.size() && !rest.empty(); ++i) {
    const Point a = window[i], way = window[i + 1 < window.size() ? i + 1 : 0] - a;
    const auto inside = [&](Point p) { return cross(way, p - a); };
    Ring cut;
    for (std::size_t k = 0; k < rest.size(); ++k) {
      const Point p = rest[k], q = rest[k + 1 < rest.size() ? k + 1 : 0];
      const double at_p = inside(p), at_q = inside(q);
      if (at_p >= 0) cut.push_back(p);
      if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) cut.push_back(p + (at_p / (at_p - at_q)) * (q - p));
    }
    rest = std::move(cut);
  }
  return rest.size() >= 3 ? rest : Ring{};
}

}  // namespace tessera
