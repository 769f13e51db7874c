#include "tessera/pavement/bend_arcs.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>

#include "tessera/tessellation/outlines.h"

namespace tessera::pavement {
namespace {

constexpr double kBendTolerance = 0.11;  // of h: how far a stone's side may leave a curved frontier
constexpr double kJointReach = 0.9;      // of h: how far a joint moves to a corner of the drawing

double distance_from_line(Point p, Point a, Point b) {
  const Point way = b - a;
  const double size = length(way);
  return size < 1e-9 ? length(p - a) : std::fabs(cross(way, p - a)) / size;
}

// Douglas-Peucker: indices of the points that keep the line within the tolerance, ends excluded.
void simplify(const std::vector<Point>& line, std::size_t begin, std::size_t end, double tolerance,
              std::vector<std::size_t>& kept) {
  double farthest = tolerance;
  std::size_t split = 0;
  for (std::size_t i = begin + 1; i < end; ++i) {
    const double d = distance_from_line(line[i], line[begin], line[end]);
    if (d > farthest) {
      farthest = d;
      split = i;
    }
  }
  if (split == 0) return;
  simplify(line, begin, split, tolerance, kept);
  kept.push_back(split);
  simplify(line, split, end, tolerance, kept);
}

class Bender {
 public:
  Bender(const Diagram& diagram, const Fields& fields, Tessellation& t)
      : graph_(diagram.graph), diagram_(diagram), fields_(fields), t_(t), bends_(graph_.arcs.size()) {}

  void follow_frontiers() {
    cv::parallel_for_({0, static_cast<int>(graph_.arcs.size())}, [&](const cv::Range& range) {
      for (int k = range.start; k < range.end; ++k) {
        const Arc& arc = graph_.arcs[k];
        if (arc.left < 0 || arc.right < 0 || t_.zone[arc.left] == t_.zone[arc.right] || arc.length < 3) continue;
        bends_[k] = bends_of(k);
      }
    });
    for (std::size_t k = 0; k < graph_.arcs.size(); ++k)
      if (!bends_[k].empty()) move_joints(static_cast<int>(k));
  }

  void assemble(const CellRings& rings) {
    complete_rings(
        graph_, rings, [this](int arc) { return course(arc); }, bends_);
    assemble_rings(graph_, rings, bends_, t_);
  }

 private:
  // The arc's course from vertex to vertex, on the frontier where it follows one.
  std::vector<Point> course(int k) const {
    const Arc& arc = graph_.arcs[k];
    std::vector<Point> line;
    for (const cv::Point corner : walk_arc(graph_, diagram_.labels, k)) {
      Point p{static_cast<double>(corner.x), static_cast<double>(corner.y)};
      if (arc.left >= 0 && arc.right >= 0 && t_.zone[arc.left] != t_.zone[arc.right])
        to_frontier(fields_.zones, t_.zone[arc.left], t_.zone[arc.right], 1.5, p);
      line.push_back(fields_.inside(p.x, p.y));
    }
    line.front() = t_.map.vertices[arc.from];
    line.back() = t_.map.vertices[arc.to];
    return line;
  }

  std::vector<Point> bends_of(int k) const {
    const std::vector<Point> line = course(k);
    std::vector<std::size_t> kept;
    simplify(line, 0, line.size() - 1, std::max(0.4, kBendTolerance * fields_.half_side), kept);
    std::vector<Point> bends;
    for (const std::size_t i : kept) bends.push_back(line[i]);
    return bends;
  }

  // Moves the arc's first or last junction into its nearest bend, where that spares a stone a hollow corner.
  void move_joints(int k) {
    const Arc& arc = graph_.arcs[k];
    std::vector<Point>& bends = bends_[k];
    if (may_move(arc.from, k, bends.front())) {
      pin(arc.from, bends.front());
      bends.erase(bends.begin());
    }
    if (!bends.empty() && may_move(arc.to, k, bends.back())) {
      pin(arc.to, bends.back());
      bends.pop_back();
    }
  }

  bool may_move(int junction, int k, Point corner) const {
    if (t_.freedom[junction] != Freedom::kFrontier) return false;
    const Point p = t_.map.vertices[junction];
    if (length(corner - p) > kJointReach * fields_.half_side) return false;
    const Arc& arc = graph_.arcs[k];
    // The hollow side: where the corner's bend turns to, seen along the arc.
    const Point far = t_.map.vertices[junction == arc.from ? arc.to : arc.from];
    const double side = cross(far - p, corner - p) * (junction == arc.from ? 1 : -1);
    const int hollow = side > 0 ? arc.right : arc.left;
    // The joint belongs to the hollow side if two of its cells meet at the junction.
    int there = 0, last = kOutside;
    for (const int label : graph_.junctions[junction].labels) {
      if (label >= 0 && label != last && t_.zone[label] == t_.zone[hollow]) ++there;
      last = label;
    }
    const auto& labels = graph_.junctions[junction].labels;
    if (labels[0] == labels[3] && labels[0] >= 0 && t_.zone[labels[0]] == t_.zone[hollow]) --there;
    return there == 2;
  }

  void pin(int vertex, Point p) {
    t_.map.vertices[vertex] = p;
    t_.freedom[vertex] = Freedom::kFixed;
  }

  const CellGraph& graph_;
  const Diagram& diagram_;
  const Fields& fields_;
  Tessellation& t_;
  Bends bends_;
};

}  // namespace

void bend_arcs(const Diagram& diagram, const Fields& fields, Tessellation& t) {
  std::vector<int> enclosing;
  const CellRings rings = cell_rings(diagram.graph, diagram.cells, enclosing);
  Bender bender(diagram, fields, t);
  bender.follow_frontiers();
  bender.assemble(rings);
}

}  // namespace tessera::pavement
