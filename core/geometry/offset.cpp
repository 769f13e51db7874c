#include "tessera/geometry/offset.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <cassert>

namespace tessera {
namespace {

namespace bg = boost::geometry;
using BoostPolygon = bg::model::polygon<bg::model::d2::point_xy<double>>;

void append_ring(const Ring& ring, BoostPolygon::ring_type& to) {
  for (const Point p : ring) to.emplace_back(p.x, p.y);
  if (!ring.empty()) to.emplace_back(ring.front().x, ring.front().y);
}

// Boost closes its rings, and turns them the other way than our screen does.
Ring ring_of(const BoostPolygon::ring_type& from) {
  Ring ring;
  for (std::size_t i = from.size(); i-- > 1;) ring.push_back({from[i].x(), from[i].y()});
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
  Polygon moved{ring_of(largest->outer()), {}};
  for (const auto& hole : largest->inners()) moved.holes.push_back(ring_of(hole));
  return moved;
}

}  // namespace tessera
