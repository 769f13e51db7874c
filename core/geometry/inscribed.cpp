#include "tessera/geometry/inscribed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace tessera {
namespace {

double distance_to(Point p, Point a, Point b) {
  const Point way = b - a;
  const double squared = dot(way, way);
  const double along = squared > 0 ? std::clamp(dot(p - a, way) / squared, 0.0, 1.0) : 0;
  return length(p - (a + along * way));
}

// To the nearest side, negative outside.
double depth(const Polygon& outline, Point p) {
  bool inside = false;
  double nearest = std::numeric_limits<double>::infinity();
  const auto look = [&](const Ring& ring) {
    Point a = ring.back();
    for (const Point b : ring) {
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
      nearest = std::min(nearest, distance_to(p, a, b));
      a = b;
    }
  };
  look(outline.outer);
  for (const Ring& hole : outline.holes) look(hole);
  return inside ? nearest : -nearest;
}

struct Square {
  Point centre;
  double half, depth;
  double at_best() const { return depth + half * 1.4142135623730951; }  // anywhere in it
};

}  // namespace

Circle largest_inscribed(const Polygon& outline, double precision) {
  Point low = outline.outer.front(), high = low;
  for (const Point p : outline.outer) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  // Heaps of different standard libraries do not have equals in one order.
  const auto worse = [](const Square& a, const Square& b) {
    if (a.at_best() != b.at_best()) return a.at_best() < b.at_best();
    return a.centre.y != b.centre.y ? a.centre.y > b.centre.y : a.centre.x > b.centre.x;
  };
  std::priority_queue<Square, std::vector<Square>, decltype(worse)> squares(worse);
  Square best{centroid(outline.outer), 0, depth(outline, centroid(outline.outer))};
  const auto add = [&](Point centre, double half) {
    const Square square{centre, half, depth(outline, centre)};
    if (square.depth > best.depth) best = square;
    if (square.at_best() > best.depth + precision) squares.push(square);
  };
  const double side = std::max(std::min(high.x - low.x, high.y - low.y), precision);
  for (double y = low.y; y < high.y; y += side)
    for (double x = low.x; x < high.x; x += side) add({x + side / 2, y + side / 2}, side / 2);
  while (!squares.empty() && squares.top().at_best() > best.depth + precision) {
    const Square square = squares.top();
    squares.pop();
    const double half = square.half / 2;
    for (const double dy : {-half, half})
      for (const double dx : {-half, half}) add(square.centre + Point{dx, dy}, half);
  }
  return {best.centre, std::max(0.0, best.depth)};
}

}  // namespace tessera
