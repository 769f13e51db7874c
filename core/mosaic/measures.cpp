#include "tessera/mosaic/measures.h"

#include <algorithm>
#include <cmath>

#include "tessera/base/portable_math.h"
#include "tessera/geometry/scan.h"

namespace tessera::mosaic {
namespace {

constexpr double kInside = 0.15;  // of a tile's side: what is deeper than this is its inside
constexpr double kThrough = 0.5;  // of a tile's side: how long an edge runs through it at least

// Direction of a tile modulo a right angle: the mean of its sides', the longer ones counting more.
double direction_of(const Ring& ring) {
  double c = 0, s = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point side = ring[i + 1 < ring.size() ? i + 1 : 0] - ring[i];
    const double size = length(side);
    if (size == 0) continue;
    const double x = side.x / size, y = side.y / size;
    const double c2 = x * x - y * y, s2 = 2 * x * y;
    c += size * (c2 * c2 - s2 * s2);
    s += size * 2 * c2 * s2;
  }
  return atan2_portable(s, c) / 4;
}

// Between two directions modulo a right angle, degrees, 0 to 45.
double angle_between(double a, double b) {
  const double turn = std::fabs(a - b) / (kPi / 2);
  return 90 * std::fabs(turn - std::round(turn));
}

double distance_to_border(const Ring& ring, Point p) {
  double least = 1e30;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], way = ring[i + 1 < ring.size() ? i + 1 : 0] - a;
    const double size2 = dot(way, way), t = size2 > 0 ? std::clamp(dot(p - a, way) / size2, 0.0, 1.0) : 0;
    least = std::min(least, length(p - (a + t * way)));
  }
  return least;
}

}  // namespace

void measure_tiles(const Fields& fields, Output& output) {
  double field_sum = 0, edge_sum = 0;
  int near_edges = 0;
  for (std::size_t i = 0; i < output.sheet.pieces.size(); ++i) {
    const Ring& ring = output.sheet.pieces[i].outline.outer;
    const double side = std::sqrt(output.areas[i]), direction = direction_of(ring);
    const Point centre = fields.inside(centroid(ring));
    field_sum += angle_between(direction, fields.direction.angle(centre.x, centre.y));
    const double distance = at(fields.distance, centre.x, centre.y);
    if (distance < 0.75 * side) {
      const Point up = fields.uphill(centre);
      if (dot(up, up) > 0) {
        edge_sum += angle_between(direction, atan2_portable(up.y, up.x));
        ++near_edges;
      }
    }
    if (distance > 1.5 * side) continue;
    int touched = 0, inside = 0;
    each_run(ring, fields.size.width, fields.size.height, [&](int y, int begin, int end) {
      for (int x = begin; x < end; ++x) {
        if (fields.edges(y, x) == 0) continue;
        ++touched;
        inside += distance_to_border(ring, {x + 0.5, y + 0.5}) > kInside * side;
      }
    });
    output.at_edges += distance < 0.75 * side || touched > 0;
    output.crossed += inside >= kThrough * side;
  }
  const auto mean = [](double sum, std::size_t count) { return count > 0 ? sum / static_cast<double>(count) : 0; };
  output.field_angle = mean(field_sum, output.sheet.pieces.size());
  output.edge_angle = mean(edge_sum, static_cast<std::size_t>(near_edges));
}

}  // namespace tessera::mosaic
