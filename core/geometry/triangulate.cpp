#include "tessera/geometry/triangulate.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace tessera {
namespace {

double turn(Point a, Point b, Point c) { return cross(b - a, c - b); }

// Its border is part of a triangle, its corners are not.
bool in_triangle(Point p, Point a, Point b, Point c) {
  if (p == a || p == b || p == c) return false;
  return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

// Whether the sides ab and cd cross or touch, other than where they end alike.
bool sides_cross(Point a, Point b, Point c, Point d) {
  if (a == c || a == d || b == c || b == d) return false;
  return turn(a, b, c) * turn(a, b, d) <= 0 && turn(c, d, a) * turn(c, d, b) <= 0;
}

class Triangulation {
 public:
  explicit Triangulation(const Polygon& polygon) {
    loop_ = add(polygon.outer, 1);
    std::vector<std::vector<std::uint32_t>> holes;
    for (const Ring& hole : polygon.holes) holes.push_back(add(hole, -1));
    for (auto hole = holes.begin(); hole != holes.end(); ++hole) join(*hole, hole + 1, holes.end());
  }

  std::vector<std::uint32_t> triangles() {
    std::vector<std::uint32_t> triangles;
    std::size_t at = 0, failed = 0;
    while (loop_.size() >= 3) {
      at %= loop_.size();
      const bool stuck = failed >= loop_.size();  // the ring crosses itself
      if (!stuck && !is_ear(at)) {
        ++at;
        ++failed;
        continue;
      }
      triangles.insert(triangles.end(), {before(at), loop_[at], after(at)});
      loop_.erase(loop_.begin() + static_cast<std::ptrdiff_t>(at));
      ++at;  // the next ear is not beside this one: a fan has thin triangles
      failed = 0;
    }
    return triangles;
  }

 private:
  using Loop = std::vector<std::uint32_t>;  // vertices in their order

  // The ring's vertices; as a loop of positive area where `sense` is 1, negative where it is -1.
  Loop add(const Ring& ring, int sense) {
    Loop loop(ring.size());
    std::iota(loop.begin(), loop.end(), static_cast<std::uint32_t>(points_.size()));
    points_.insert(points_.end(), ring.begin(), ring.end());
    if (ring.size() >= 3 && signed_area(ring) * sense < 0) std::reverse(loop.begin(), loop.end());
    return loop;
  }

  std::uint32_t before(std::size_t k) const { return loop_[k > 0 ? k - 1 : loop_.size() - 1]; }
  std::uint32_t after(std::size_t k) const { return loop_[k + 1 < loop_.size() ? k + 1 : 0]; }

  bool is_ear(std::size_t k) const {
    const Point a = points_[before(k)], b = points_[loop_[k]], c = points_[after(k)];
    if (turn(a, b, c) <= 0) return false;
    return std::none_of(loop_.begin(), loop_.end(),
                        [&](std::uint32_t vertex) { return in_triangle(points_[vertex], a, b, c); });
  }

  // Whether the way from the loop's k-th vertex to p begins inside the loop.
  bool begins_inside(std::size_t k, Point p) const {
    const Point a = points_[before(k)], b = points_[loop_[k]], c = points_[after(k)];
    const bool right_of_in = turn(a, b, p) > 0, right_of_out = turn(b, c, p) > 0;
    return turn(a, b, c) > 0 ? right_of_in && right_of_out : right_of_in || right_of_out;
  }

  bool crosses(const Loop& loop, Point a, Point b) const {
    for (std::size_t k = 0; k < loop.size(); ++k)
      if (sides_cross(a, b, points_[loop[k]], points_[loop[k + 1 < loop.size() ? k + 1 : 0]])) return true;
    return false;
  }

  // Joins a hole to the loop by the shortest way that crosses neither them nor the holes that are still to come.
  template <class Holes>
  void join(const Loop& hole, Holes first_other, Holes last_other) {
    std::size_t best_k = 0, best_h = 0;
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < loop_.size(); ++k)
      for (std::size_t h = 0; h < hole.size(); ++h) {
        const Point a = points_[loop_[k]], b = points_[hole[h]];
        const double way = dot(b - a, b - a);
        if (way >= best || !begins_inside(k, b) || crosses(loop_, a, b) || crosses(hole, a, b)) continue;
        if (std::any_of(first_other, last_other, [&](const Loop& other) { return crosses(other, a, b); })) continue;
        best = way, best_k = k, best_h = h;
      }
    Loop bridge(hole.begin() + static_cast<std::ptrdiff_t>(best_h), hole.end());
    bridge.insert(bridge.end(), hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(best_h) + 1);
    bridge.push_back(loop_[best_k]);
    loop_.insert(loop_.begin() + static_cast<std::ptrdiff_t>(best_k) + 1, bridge.begin(), bridge.end());
  }

  std::vector<Point> points_;
  Loop loop_;
};

}  // namespace

std::vector<std::uint32_t> triangulate(const Polygon& polygon) { return Triangulation(polygon).triangles(); }

}  // namespace tessera
