#include "tessera/pavement/paper_stones.h"

#include <algorithm>
#include <cmath>

#include "tessera/base/portable_math.h"
#include "tessera/geometry/planar_map.h"

namespace tessera::pavement {
namespace {

// Vertices at the pixel corners where 3 or 4 labels meet (2 along the border), given to each of their cells; each
// cell's then sorted by their angle around their mean.
PlanarMap extract(const Diagram& diagram) {
  PlanarMap map;
  std::vector<std::vector<int>> rings(diagram.cells);
  for (const Junction& junction : diagram.graph.junctions) {
    for (int k = 0; k < 4; ++k) {
      const int label = junction.labels[k];
      const auto end = junction.labels.begin() + k;
      if (label >= 0 && std::find(junction.labels.begin(), end, label) == end)
        rings[label].push_back(static_cast<int>(map.vertices.size()));
    }
    map.vertices.push_back({static_cast<double>(junction.x), static_cast<double>(junction.y)});
  }
  for (auto& ring : rings) {
    Point centre;
    for (const int v : ring) centre += (1.0 / static_cast<double>(ring.size())) * map.vertices[v];
    std::stable_sort(ring.begin(), ring.end(), [&](int a, int b) {
      const Point p = map.vertices[a] - centre, q = map.vertices[b] - centre;
      return atan2_portable(p.y, p.x) < atan2_portable(q.y, q.x);
    });
    map.ring.insert(map.ring.end(), ring.begin(), ring.end());
    map.first.push_back(static_cast<int>(map.ring.size()));
  }
  return map;
}

double cosine_at(Point previous, Point p, Point next) {
  const Point a = previous - p, b = next - p;
  const double size = length(a) * length(b);
  return size > 0 ? dot(a, b) / size : -1;
}

// Moves each vertex of a wide angle onto the line between its neighbours, on the shared map.
void flatten_wide_angles(PlanarMap& map, double cosine) {
  for (int cell = 0; cell < map.cells(); ++cell) {
    for (int slot = map.first[cell]; slot < map.first[cell + 1]; ++slot) {
      const Point a = map.at(map.previous(cell, slot)), b = map.at(map.next(cell, slot)), way = b - a;
      Point& p = map.vertices[map.ring[slot]];
      if (dot(way, way) == 0 || cosine_at(a, p, b) > cosine) continue;
      p = a + std::clamp(dot(p - a, way) / dot(way, way), 0.0, 1.0) * way;
    }
  }
}

// Moves vertices in another colour than their stone's along the distance field's gradient to the edge.
void move_to_edges(PlanarMap& map, const Diagram& diagram, const Fields& fields) {
  for (int cell = 0; cell < map.cells(); ++cell) {
    for (int slot = map.first[cell]; slot < map.first[cell + 1]; ++slot) {
      Point& p = map.vertices[map.ring[slot]];
      const int zone = fields.zone_at(p.x, p.y);
      if (zone < 0 || zone == diagram.cell_zone[cell]) continue;
      const cv::Vec2d up = uphill(fields.distance, p.x, p.y, 1);
      const double distance = at(fields.distance, p.x, p.y);
      if (distance < 2 * fields.half_side) p -= distance * Point{up[0], up[1]};
    }
  }
}

// Each polygon alone: no wide angles, no tiny edges, but four vertices at least.
Ring separate(const PlanarMap& map, int cell, double cosine, double shortest) {
  Ring ring = map.outline(cell);
  const auto drop_while = [&](const auto& useless) {
    for (std::size_t i = 0; i < ring.size() && ring.size() > 4;) {
      const Point a = ring[(i + ring.size() - 1) % ring.size()], b = ring[(i + 1) % ring.size()];
      if (useless(a, ring[i], b)) {
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
      } else {
        ++i;
      }
    }
  };
  drop_while([&](Point a, Point p, Point b) { return cosine_at(a, p, b) <= cosine; });
  drop_while([&](Point, Point p, Point b) { return length(b - p) < shortest; });
  return ring;
}

}  // namespace

PaperStones paper_stones(const Diagram& diagram, const Fields& fields, const Params& params) {
  PlanarMap map = extract(diagram);
  const double cosine = sin_cos(params.wide_angle * kPi / 180).cos;
  PaperStones stones;
  for (int cell = 0; cell < map.cells(); ++cell) stones.vertices_before.push_back(map.corners(cell));
  flatten_wide_angles(map, cosine);
  move_to_edges(map, diagram, fields);
  for (int cell = 0; cell < map.cells(); ++cell)
    stones.rings.push_back(separate(map, cell, cosine, 0.2 * fields.half_side));
  return stones;
}

}  // namespace tessera::pavement
