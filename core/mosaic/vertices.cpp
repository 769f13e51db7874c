#include "tessera/mosaic/vertices.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>

#include "tessera/base/portable_math.h"
#include "tessera/geometry/polygon.h"
#include "tessera/tessellation/outlines.h"
#include "tessera/voronoi/equidistant.h"

namespace tessera::mosaic {
namespace {

constexpr double kLimit = 1.5;      // px a vertex may move away from its corner to be equally far from its sites
constexpr double kEdgeReach = 0.3;  // of a tile's side: how far a vertex moves to an edge or line

// Moves p onto the edge or line next to it; false, and p stays, where that does not lead within half a pixel of one.
bool to_edge(const Fields& fields, double reach, Point& p) {
  Point q = p;
  for (int i = 0; i < 4; ++i) {
    const double distance = at(fields.to_line, q.x, q.y);
    if (distance < 0.3) break;
    q = q - distance * fields.uphill_of(fields.to_line, q);
    if (length(q - p) > reach) return false;
  }
  if (at(fields.to_line, q.x, q.y) > 0.75) return false;
  p = q;
  return true;
}

class Placer {
 public:
  Placer(const Diagram& diagram, const Fields& fields) : diagram_(diagram), fields_(fields) {
    frames_.reserve(diagram.sites.size());
    for (const Site& site : diagram.sites) frames_.emplace_back(site, Metric::kChebyshev);
  }

  void place(const Junction& junction, Point& p, Freedom& freedom, Point& normal) const {
    std::array<int, 4> cells{};
    int count = 0;
    bool at_border = false;
    for (const int label : junction.labels) {
      at_border |= label == kOutside;
      if (label == kOutside || std::find(cells.begin(), cells.begin() + count, label) != cells.begin() + count)
        continue;
      cells[count++] = label;
    }
    p = {static_cast<double>(junction.x), static_cast<double>(junction.y)};
    normal = {0, 0};
    if (at_border) {
      place_on_border(junction, cells, count, p, freedom, normal);
      return;
    }
    freedom = Freedom::kFree;
    if (count >= 3 && is_site(cells[0]) && is_site(cells[1]) && is_site(cells[2])) {
      Point q = p;
      if (make_equidistant(frames_[cells[0]], frames_[cells[1]], frames_[cells[2]], kLimit, q)) p = fields_.inside(q);
    }
    const double reach = kEdgeReach * fields_.side(p.x, p.y);
    if (at(fields_.to_line, p.x, p.y) > reach) return;
    const Point away = fields_.uphill_of(fields_.to_line, p);
    if (to_edge(fields_, 1.5 * reach, p)) {
      p = fields_.inside(p);
      freedom = Freedom::kFrontier;
      normal = away;
    }
  }

 private:
  bool is_site(int cell) const { return cell < static_cast<int>(frames_.size()); }

  void place_on_border(const Junction& junction, const std::array<int, 4>& cells, int count, Point& p,
                       Freedom& freedom, Point& normal) const {
    const bool at_side = junction.x == 0 || junction.x == diagram_.labels.cols;
    const bool at_end = junction.y == 0 || junction.y == diagram_.labels.rows;
    freedom = Freedom::kFixed;
    if (at_side && at_end) return;
    const Point along = at_side ? Point{0, 1} : Point{1, 0};
    freedom = Freedom::kBorder;
    normal = {along.y, along.x};
    if (count < 2 || !is_site(cells[0]) || !is_site(cells[1])) return;
    Point q = p;
    if (make_equidistant_along(frames_[cells[0]], frames_[cells[1]], along, kLimit, q)) p = fields_.inside(q);
  }

  const Diagram& diagram_;
  const Fields& fields_;
  std::vector<SiteDistance> frames_;
};

// Cells whose outline crosses itself, since vertices were drawn past each other, get their pixel corners back.
void untangle(const CellGraph& graph, Tessellation& t) {
  for (bool again = true; again;) {
    again = false;
    for (int cell = 0; cell < t.cells(); ++cell) {
      const Ring ring = t.map.outline(cell);
      if (ring.empty() || (signed_area(ring) > 0 && is_simple(ring))) continue;
      for (int slot = t.map.first[cell]; slot < t.map.first[cell + 1]; ++slot) {
        const int v = t.map.ring[slot];
        if (v >= static_cast<int>(graph.junctions.size())) continue;
        const Point corner{static_cast<double>(graph.junctions[v].x), static_cast<double>(graph.junctions[v].y)};
        if (t.map.vertices[v] == corner) continue;
        again = true;
        t.map.vertices[v] = corner;
        if (t.freedom[v] == Freedom::kFrontier) t.freedom[v] = Freedom::kFree, t.normal[v] = {0, 0};
      }
    }
  }
}

}  // namespace

Tessellation place_vertices(const Diagram& diagram, const Fields& fields) {
  const CellGraph& graph = diagram.graph;
  const Placer placer(diagram, fields);
  const std::size_t n = graph.junctions.size();
  Tessellation t;
  t.zone.assign(diagram.cells, 0);
  t.half_side.resize(diagram.cells);
  t.frame.resize(diagram.cells);
  for (int cell = 0; cell < diagram.cells; ++cell) {
    const bool has_site = cell < static_cast<int>(diagram.sites.size());
    t.half_side[cell] = has_site ? std::min(diagram.sites[cell].extent_u, diagram.sites[cell].extent_v) : 2.0f;
    const SinCos turn = sin_cos(has_site ? diagram.sites[cell].angle : 0);
    t.frame[cell] = {turn.cos, turn.sin};
  }
  t.set_vertices(n);
  cv::parallel_for_({0, static_cast<int>(n)}, [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i)
      placer.place(graph.junctions[i], t.map.vertices[i], t.freedom[i], t.normal[i]);
  });
  std::vector<int> enclosing;
  const CellRings rings = cell_rings(graph, diagram.cells, enclosing);
  Bends bends(graph.arcs.size());
  const Course course = [&](int arc) {
    std::vector<Point> line;
    for (const cv::Point corner : walk_arc(graph, diagram.labels, arc))
      line.push_back({static_cast<double>(corner.x), static_cast<double>(corner.y)});
    line.front() = t.map.vertices[graph.arcs[arc].from];
    line.back() = t.map.vertices[graph.arcs[arc].to];
    return line;
  };
  complete_rings(graph, rings, course, bends);
  const Torus& torus = fields.torus;
  std::vector<int> shared;
  if (torus.wraps()) shared = share_bends(torus, graph, bends);
  assemble_rings(graph, rings, bends, t);
  if (torus.wraps()) fold(torus, graph, bends, shared, diagram.own, static_cast<int>(diagram.sites.size()), t);
  untangle(graph, t);
  return t;
}

Point back_to_edge(const Tessellation& t, const Fields& fields, int vertex, Point p) {
  if (t.freedom[vertex] == Freedom::kFrontier) to_edge(fields, 2, p);
  return fields.inside(p);
}

std::vector<Ring> whole_cells(const Tessellation& t) {
  std::vector<Ring> rings(t.cells());
  for (int cell = 0; cell < t.cells(); ++cell) rings[cell] = t.map.outline(cell);
  return rings;
}

}  // namespace tessera::mosaic
