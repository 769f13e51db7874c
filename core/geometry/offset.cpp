#include "tessera/geometry/offset.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <cassert>
#include <cmath>

namespace tessera {
namespace {

namespace bg = boost::geometry;
using BoostPolygon = bg::model::polygon<bg::model::d2::point_xy<double>>;

void append_ring(const Ring& ring, BoostPolygon::ring_type& to) {
  for (const Point p : ring) to.emplace_back(p.x, p.y);
  if (!ring.empty()) to.emplace_back(ring.front().x, ring.front().y);
}

// Boost closes its rings, and turns them the other way than our screen does. Where it has joined parts it leaves
// vertices that are no corners; they go if they are no farther from the line between their neighbours than
// `tolerance`.
Ring ring_of(const BoostPolygon::ring_type& from, double tolerance) {
  Ring ring;
  for (std::size_t i = from.size(); i-- > 1;) ring.push_back({from[i].x(), from[i].y()});
  const auto is_corner = [&](std::size_t i) {
    const Point a = ring[i > 0 ? i - 1 : ring.size() - 1], b = ring[i + 1 < ring.size() ? i + 1 : 0];
    const double side = length(b - a);
    return length(ring[i] - a) > tolerance &&
           (side < tolerance || std::abs(cross(b - a, ring[i] - a)) > tolerance * side ||
            dot(b - a, ring[i] - a) < 0);
  };
  for (std::size_t i = ring.size(); i-- > 0 && ring.size() > 3;)
    if (!is_corner(i)) ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
  return ring;
}

}  // namespace

Polygon grown(const Polygon& outline, double distance) {
  assert(distance >= 0 && outline.outer.size() >= 3);
  if (distance == 0) return outline;
  constexpr double kLongestCorner = 5;
  BoostPolygon polygon;
  append_ring(outline.outer, polygon.outer());
  for (const Ring& hole : outline.holes) append_ring(hole, polygon.inners().emplace_back());
  bg::correct(polygon);
  bg::model::multi_polygon<BoostPolygon> result;
  bg::buffer(polygon, result, bg::strategy::buffer::distance_symmetric<double>(distance),
             bg::strategy::buffer::side_straight(), bg::strategy::buffer::join_miter(kLongestCorner),
             bg::strategy::buffer::end_flat(), bg::strategy::buffer::point_square());
  const auto smaller = [](const auto& a, const auto& b) { return bg::area(a) < bg::area(b); };
  const auto largest = std::max_element(result.begin(), result.end(), smaller);
  assert(largest != result.end());
  const double tolerance = 1e-3 * distance;
  Polygon moved{ring_of(largest->outer(), tolerance), {}};
  for (const auto& hole : largest->inners()) moved.holes.push_back(ring_of(hole, tolerance));
  return moved;
}

}  // namespace tessera
