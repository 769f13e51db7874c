#include "tessera/tessellation/outlines.h"

#include <algorithm>

namespace tessera {
namespace {

// Points that divide a course into equal parts.
std::vector<Point> spread(const std::vector<Point>& line, int count) {
  std::vector<Point> points;
  for (int i = 1; i <= count; ++i) {
    const double where = static_cast<double>(i) * static_cast<double>(line.size() - 1) / (count + 1);
    const std::size_t a = static_cast<std::size_t>(where), b = std::min(a + 1, line.size() - 1);
    points.push_back(line[a] + (where - static_cast<double>(a)) * (line[b] - line[a]));
  }
  return points;
}

}  // namespace

void complete_rings(const CellGraph& graph, const CellRings& rings, const Course& course, Bends& bends) {
  for (int cell = 0; cell < rings.cells(); ++cell) {
    const auto ring = rings[cell];
    int corners = 0;
    for (const int h : ring) corners += 1 + static_cast<int>(bends[h >> 1].size());
    if (ring.empty() || corners >= 4) continue;
    int longest = ring.front() >> 1;
    for (const int h : ring)
      if (graph.arcs[h >> 1].length > graph.arcs[longest].length) longest = h >> 1;
    bends[longest] = spread(course(longest), static_cast<int>(bends[longest].size()) + 4 - corners);
  }
}

void assemble_rings(const CellGraph& graph, const CellRings& rings, const Bends& bends, Tessellation& t) {
  std::vector<int> first(bends.size());
  for (std::size_t k = 0; k < bends.size(); ++k) {
    first[k] = static_cast<int>(t.map.vertices.size());
    const Arc& arc = graph.arcs[k];
    const bool fixed = arc.left < 0 || arc.right < 0 || t.zone[arc.left] != t.zone[arc.right];
    for (const Point p : bends[k]) {
      t.map.vertices.push_back(p);
      t.freedom.push_back(fixed ? Freedom::kFixed : Freedom::kFree);
      t.normal.push_back({0, 0});
      t.between.push_back({});
    }
  }
  for (int cell = 0; cell < rings.cells(); ++cell) {
    for (const int h : rings[cell]) {
      t.map.ring.push_back(graph.tail(h));
      const int k = h >> 1, n = static_cast<int>(bends[k].size());
      for (int i = 0; i < n; ++i) t.map.ring.push_back(first[k] + (h & 1 ? n - 1 - i : i));
    }
    t.map.first.push_back(static_cast<int>(t.map.ring.size()));
  }
}

}  // namespace tessera
