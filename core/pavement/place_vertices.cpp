#include "tessera/pavement/place_vertices.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>

#include "tessera/geometry/polygon.h"
#include "tessera/pavement/bend_arcs.h"
#include "tessera/voronoi/equidistant.h"

namespace tessera::pavement {
namespace {

Point frontier_gradient(const Zones& zones, int a, int b, Point p) {
  constexpr double kStep = 0.5;
  return {(zones.frontier(p.x + kStep, p.y, a, b) - zones.frontier(p.x - kStep, p.y, a, b)) / (2 * kStep),
          (zones.frontier(p.x, p.y + kStep, a, b) - zones.frontier(p.x, p.y - kStep, a, b)) / (2 * kStep)};
}

// The labels around a junction, each once, in cyclic order.
struct Meeting {
  std::array<int, 4> cells{};
  int count = 0;
  bool at_border = false;
  std::array<int, 2> zones{-1, -1};  // the zones that meet
  int zone_count = 0;

  Meeting(const Junction& junction, const std::vector<std::uint8_t>& cell_zone) {
    for (const int label : junction.labels) {
      if (label == kOutside) at_border = true;
      if (label == kOutside || std::find(cells.begin(), cells.begin() + count, label) != cells.begin() + count)
        continue;
      cells[count++] = label;
      const int zone = cell_zone[label];
      if (zone == zones[0] || zone == zones[1]) continue;
      if (zone_count < 2) zones[zone_count] = zone;
      ++zone_count;
    }
  }
};

class Placer {
 public:
  Placer(const Diagram& diagram, const Fields& fields) : diagram_(diagram), fields_(fields) {
    frames_.reserve(diagram.sites.size());
    for (const Site& site : diagram.sites) frames_.emplace_back(site, Metric::kFrustum);
  }

  // Position, freedom and normal of one junction, and the zones it is between.
  void place(const Junction& junction, Point& p, Freedom& freedom, Point& normal,
             std::array<std::uint8_t, 2>& between) const {
    const Meeting meeting(junction, diagram_.cell_zone);
    for (int k = 0; k < std::min(2, meeting.zone_count); ++k)
      between[k] = static_cast<std::uint8_t>(meeting.zones[k]);
    p = {static_cast<double>(junction.x), static_cast<double>(junction.y)};
    normal = {0, 0};
    if (meeting.at_border) {
      place_on_border(junction, meeting, p, freedom, normal);
    } else if (meeting.zone_count == 1) {
      freedom = Freedom::kFree;
      balance(meeting, p);
    } else if (meeting.zone_count == 2) {
      place_on_frontier(meeting, p, freedom, normal);
    } else {
      freedom = Freedom::kFixed;  // three zones meet in one point of the drawing
    }
    p = fields_.inside(p.x, p.y);
  }

 private:
  static constexpr double kLimit = 1.5;  // pixels a vertex may move away from its corner

  const SiteDistance* frame(int cell) const {
    return cell < static_cast<int>(frames_.size()) ? &frames_[cell] : nullptr;
  }

  // Equally far from the first three sites, within the picture.
  void balance(const Meeting& meeting, Point& p) const {
    const SiteDistance* sites[3];
    for (int k = 0; k < 3; ++k)
      if (!(sites[k] = frame(meeting.cells[k]))) return;
    Point q = p;
    if (make_equidistant(*sites[0], *sites[1], *sites[2], kLimit, q) && q == fields_.inside(q.x, q.y)) p = q;
  }

  // Slides p along a line until the first two sites of the meeting that share a zone are equally far.
  void balance_along(const Meeting& meeting, Point direction, Point& p) const {
    for (int i = 0; i < meeting.count; ++i) {
      for (int j = i + 1; j < meeting.count; ++j) {
        const SiteDistance *a = frame(meeting.cells[i]), *b = frame(meeting.cells[j]);
        if (!a || !b || diagram_.cell_zone[meeting.cells[i]] != diagram_.cell_zone[meeting.cells[j]]) continue;
        make_equidistant_along(*a, *b, direction, kLimit, p);
        return;
      }
    }
  }

  void place_on_frontier(const Meeting& meeting, Point& p, Freedom& freedom, Point& normal) const {
    const auto [a, b] = meeting.zones;
    freedom = Freedom::kFixed;
    if (!to_frontier(fields_.zones, a, b, kLimit, p)) return;
    const Point across = frontier_gradient(fields_.zones, a, b, p);
    const double size = length(across);
    if (size < 1e-3) return;
    freedom = Freedom::kFrontier;
    normal = (1 / size) * across;
    if (meeting.count != 3) return;
    Point q = p;
    balance_along(meeting, {-normal.y, normal.x}, q);
    if (to_frontier(fields_.zones, a, b, kLimit, q) && q == fields_.inside(q.x, q.y)) p = q;
  }

  void place_on_border(const Junction& junction, const Meeting& meeting, Point& p, Freedom& freedom,
                       Point& normal) const {
    const bool at_side = junction.x == 0 || junction.x == diagram_.labels.cols;
    const bool at_end = junction.y == 0 || junction.y == diagram_.labels.rows;
    freedom = Freedom::kFixed;
    if (at_side && at_end) return;
    const Point along = at_side ? Point{0, 1} : Point{1, 0};
    if (meeting.zone_count == 1) {
      freedom = Freedom::kBorder;
      normal = {along.y, along.x};
      balance_along(meeting, along, p);
    } else if (meeting.zone_count == 2) {
      const Point q = p;
      if (to_frontier(fields_.zones, meeting.zones[0], meeting.zones[1], kLimit, p))
        p = q + dot(p - q, along) * along;
    }
  }

  const Diagram& diagram_;
  const Fields& fields_;
  std::vector<SiteDistance> frames_;
};

// What is smaller than a stone by far is a speck of the drawing, and too small for vertices to slide around it: which
// way they would go, the least difference decides.
void hold_specks(Tessellation& t) {
  constexpr double kSpeck = 0.25;  // h squared
  for (int cell = 0; cell < t.cells(); ++cell) {
    if (std::abs(signed_area(t.map.outline(cell))) > kSpeck * t.half_side[cell] * t.half_side[cell]) continue;
    for (int slot = t.map.first[cell]; slot < t.map.first[cell + 1]; ++slot)
      if (Freedom& freedom = t.freedom[t.map.ring[slot]]; freedom == Freedom::kFrontier) freedom = Freedom::kFixed;
  }
}

}  // namespace

bool to_frontier(const Zones& zones, int a, int b, double limit, Point& p) {
  Point q = p;
  for (int i = 0; i < 5; ++i) {
    const double value = zones.frontier(q.x, q.y, a, b);
    if (std::fabs(value) < 2e-3) break;
    const Point slope = frontier_gradient(zones, a, b, q);
    const double steep = dot(slope, slope);
    if (steep < 1e-4) return false;
    Point step = (-value / steep) * slope;
    if (length(step) > 1) step = (1 / length(step)) * step;
    q += step;
    if (length(q - p) > limit) return false;
  }
  if (std::fabs(zones.frontier(q.x, q.y, a, b)) > 0.05) return false;
  p = q;
  return true;
}

Point back_to_frontier(const Tessellation& t, const Fields& fields, int vertex, Point p) {
  if (t.freedom[vertex] == Freedom::kFrontier)
    to_frontier(fields.zones, t.between[vertex][0], t.between[vertex][1], 1, p);
  return fields.inside(p.x, p.y);
}

Tessellation place_vertices(const Diagram& diagram, const Fields& fields) {
  const CellGraph& graph = diagram.graph;
  const Placer placer(diagram, fields);
  const std::size_t n = graph.junctions.size();
  Tessellation t;
  t.zone = diagram.cell_zone;
  t.half_side.assign(t.zone.size(), static_cast<float>(fields.half_side));
  t.set_vertices(n);
  cv::parallel_for_({0, static_cast<int>(n)}, [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i)
      placer.place(graph.junctions[i], t.map.vertices[i], t.freedom[i], t.normal[i], t.between[i]);
  });
  bend_arcs(diagram, fields, t);
  hold_specks(t);
  for (Point& p : t.map.vertices) p = snapped(p);
  return t;
}

}  // namespace tessera::pavement
