#include "tessera/tessellation/relax.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core/utility.hpp>
#include <utility>

#include "tessera/geometry/polygon.h"

namespace tessera {
namespace {

constexpr double kSlide = 0.35;     // of h: how far a vertex slides along a frontier
constexpr double kTouching = 0.02;  // of h: corners nearer than this are one
constexpr double kBlock = 24;       // of the largest h: side of the blocks that are relaxed side by side
constexpr double kMargin = 0.15;    // of the line between its neighbours: how near a vertex comes to either

class Relaxer {
 public:
  Relaxer(Tessellation& t, const std::vector<char>& flat, const RelaxParams& params)
      : t_(t), map_(t.map), flat_(flat), params_(params) {
    nodes_.reserve(t.map.vertices.size());
    for (std::size_t v = 0; v < t.map.vertices.size(); ++v)
      nodes_.push_back(
          {t.map.vertices[v], t.map.vertices[v], t.normal[v], mobility(t.freedom[v]), 1e30, t.freedom[v]});
    list_corners();
  }

  // One round moves corner after corner, each from where the last one left its neighbours. Every other block of the
  // picture, across and down, has no vertex in common with the rest of those, so they go side by side.
  //
  // `pull`: how strongly vertices are drawn back to where they began.
  void round(double pull) {
    cv::parallel_for_({0, static_cast<int>(nodes_.size())}, [&](const cv::Range& range) {
      for (int v = range.start; v < range.end; ++v) {
        Node& node = nodes_[v];
        node.p = snapped(node.p);
        if (node.freedom == Freedom::kFrontier || (pull > 0 && node.freedom != Freedom::kFixed))
          move(node, pull * (node.begin - node.p));
      }
    });
    for (const auto& blocks : blocks_)
      cv::parallel_for_({0, static_cast<int>(blocks.size())}, [&](const cv::Range& range) {
        for (int block = range.start; block < range.end; ++block)
          for (const Corner& corner : blocks[block]) straighten(corner);
      });
    for (const Corner& corner : far_) straighten(corner);
  }

  // Draws the corners of pieces with four towards the rectangle in the piece's frame that fits them best.
  void square_up(double strength) {
    const std::size_t slots = map_.ring.size();
    way_.assign(slots, {0, 0});
    cv::parallel_for_({0, map_.cells()}, [&](const cv::Range& range) {
      for (int cell = range.start; cell < range.end; ++cell) fit_rectangle(cell);
    });
    pull_.assign(nodes_.size(), {0, 0});
    pulls_.assign(nodes_.size(), 0);
    for (std::size_t slot = 0; slot < slots; ++slot) {
      if (way_[slot].x == 0 && way_[slot].y == 0) continue;
      pull_[map_.ring[slot]] += way_[slot];
      ++pulls_[map_.ring[slot]];
    }
    for (std::size_t v = 0; v < nodes_.size(); ++v)
      if (pulls_[v] > 0 && nodes_[v].freedom != Freedom::kFixed) move(nodes_[v], (strength / pulls_[v]) * pull_[v]);
  }

  // Sliding along a tangent leaves a curved frontier.
  void back_to_frontier(const Back& back) {
    cv::parallel_for_({0, static_cast<int>(nodes_.size())}, [&](const cv::Range& range) {
      for (int v = range.start; v < range.end; ++v) {
        nodes_[v].p = back(v, nodes_[v].p);
      }
    });
  }

  // What is undone later goes back there, too.
  void pin(const std::vector<Pin>& pins) {
    for (const Pin& pin : pins) nodes_[pin.vertex].p = nodes_[pin.vertex].begin = pin.place;
  }

  // Moves the tessellation's vertices to where the rounds have led.
  void apply() {
    for (std::size_t v = 0; v < nodes_.size(); ++v) map_.vertices[v] = snapped(nodes_[v].p);
  }

  // Undoes the moves of tangled pieces, until none is left that undoing helps.
  void untangle(std::vector<char>& flat) {
    std::vector<char> undone(map_.vertices.size(), 0), tangled(map_.cells());
    const auto undo_tangled = [&] {
      bool undid = false;
      cv::parallel_for_({0, map_.cells()}, [&](const cv::Range& range) {
        Ring corners;
        for (int cell = range.start; cell < range.end; ++cell) tangled[cell] = is_tangled(cell, corners);
      });
      Ring corners;
      for (int cell = 0; cell < map_.cells(); ++cell) {
        const auto begin = map_.ring.begin() + map_.first[cell], end = map_.ring.begin() + map_.first[cell + 1];
        // Undoing the moves of a neighbour may have mended it, or spoilt it.
        const bool changed = std::any_of(begin, end, [&](int v) { return undone[v] != 0; });
        if (!(changed ? is_tangled(cell, corners) : tangled[cell] != 0)) continue;
        for (auto v = begin; v != end; ++v) {
          if (undone[*v]) continue;
          undone[*v] = 1;
          undid = true;
          map_.vertices[*v] = nodes_[*v].begin;
        }
      }
      for (std::size_t slot = 0; slot < flat.size(); ++slot)
        if (undone[map_.ring[slot]]) flat[slot] = 0;
      return undid;
    };
    // What is a corner after all may tangle its piece in turn.
    do {
      while (undo_tangled()) {
      }
      cv::parallel_for_({0, map_.cells()}, [&](const cv::Range& range) {
        for (int cell = range.start; cell < range.end; ++cell) {
          while (keep_straight(cell, flat)) {
          }
        }
      });
    } while (undo_tangled());
  }

 private:
  // A vertex that is not on its piece's side after all is a corner of the piece: left out, its neighbours would
  // overlap. Returns whether there was one.
  bool keep_straight(int cell, std::vector<char>& flat) const {
    bool changed = false;
    for (int slot = map_.first[cell]; slot < map_.first[cell + 1]; ++slot) {
      const Freedom freedom = t_.freedom[map_.ring[slot]];
      const bool bound = freedom == Freedom::kFree || (params_.frontiers_too && freedom == Freedom::kFrontier);
      if (!flat[slot] || !bound) continue;
      int a = map_.previous(cell, slot), b = map_.next(cell, slot);
      while (flat[a] && a != slot) a = map_.previous(cell, a);
      while (flat[b] && b != slot) b = map_.next(cell, b);
      const Point way = map_.at(b) - map_.at(a);
      // Positive: into the piece, as rings are clockwise on the screen.
      const double off = cross(way, map_.at(slot) - map_.at(a)), unit = t_.half_side[cell] * length(way);
      if (off > params_.overlap * unit || off < -params_.gap * unit) {
        flat[slot] = 0;
        changed = true;
      }
    }
    return changed;
  }

  // Corners that cross or coincide, or an outline turned over. `ring` is memory to work in: to get some for each
  // cell, threads would have to queue.
  bool is_tangled(int cell, Ring& ring) const {
    ring.clear();
    for (int slot = map_.first[cell]; slot < map_.first[cell + 1]; ++slot)
      if (!flat_[slot]) ring.push_back(map_.at(slot));
    bool convex = true;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i], b = ring[(i + 1) % ring.size()], c = ring[(i + 2) % ring.size()];
      if (length(b - a) < kTouching * t_.half_side[cell]) return true;
      convex &= cross(b - a, c - b) >= 0;
    }
    if (signed_area(ring) <= 0) return true;
    return !(convex && ring.size() == 4) && !is_simple(ring);
  }

  // A vertex with all that its moves need, side by side.
  struct Node {
    Point p, begin, normal;
    double mobility, slide;
    Freedom freedom;
  };

  // Where the slot's vertex is by now.
  Point place_of(int slot) const {
    const Point p = nodes_[map_.ring[slot]].p;
    return map_.shift.empty() ? p : p + map_.shift[slot];
  }

  void fit_rectangle(int cell) {
    int slot_of[4], n = 0;
    for (int slot = map_.first[cell]; slot < map_.first[cell + 1]; ++slot) {
      if (flat_[slot]) continue;
      if (n == 4) return;
      slot_of[n++] = slot;
    }
    if (n != 4) return;
    const Point axis = t_.frame[cell];
    Point corner[4], centre;
    for (int k = 0; k < 4; ++k) centre += 0.25 * place_of(slot_of[k]);
    for (int k = 0; k < 4; ++k) {
      const Point off = place_of(slot_of[k]) - centre;
      corner[k] = {dot(off, axis), cross(axis, off)};
    }
    // Which corner is the rectangle's first: of the four ways the one that fits best.
    constexpr double kSignU[] = {-1, 1, 1, -1}, kSignV[] = {-1, -1, 1, 1};
    int first = 0;
    double best = -1e30, half_u = 0, half_v = 0;
    for (int turn = 0; turn < 4; ++turn) {
      double u = 0, v = 0;
      for (int k = 0; k < 4; ++k) {
        u += 0.25 * kSignU[(k + turn) & 3] * corner[k].x;
        v += 0.25 * kSignV[(k + turn) & 3] * corner[k].y;
      }
      if (u > 0 && v > 0 && u + v > best) best = u + v, first = turn, half_u = u, half_v = v;
    }
    if (best < 0) return;
    for (int k = 0; k < 4; ++k) {
      const Point off{kSignU[(k + first) & 3] * half_u - corner[k].x, kSignV[(k + first) & 3] * half_v - corner[k].y};
      way_[slot_of[k]] = {off.x * axis.x - off.y * axis.y, off.x * axis.y + off.y * axis.x};
    }
  }

  // How far a vertex gives way. Those on frontiers little: a slide around a corner of the drawing would cut it off.
  static double mobility(Freedom freedom) {
    switch (freedom) {
      case Freedom::kFree: return 0.5;
      case Freedom::kFrontier: return 0.15;
      case Freedom::kBorder: return 0.5;
      case Freedom::kFixed: break;
    }
    return 0;
  }

  void move(Node& node, Point by) const {
    node.p += by - dot(by, node.normal) * node.normal;
    if (node.freedom != Freedom::kFrontier) return;
    const Point way = node.p - node.begin;
    if (length(way) > node.slide) node.p = node.begin + (node.slide / length(way)) * way;
  }

  // A free vertex between its neighbours in a stone's outline. On a frontier the drawing rules, not the straight
  // line.
  struct Corner {
    int vertex, before, after;
    int shifts;  // of its neighbours against the vertex, in shifts_; -1: none
    bool flat;
  };

  // How far both neighbours of a slot lie from where their vertices say, seen from the slot's vertex.
  int shifts_of(int slot, int before, int after) {
    if (map_.shift.empty()) return -1;
    const std::pair<Point, Point> shifts{map_.shift[before] - map_.shift[slot], map_.shift[after] - map_.shift[slot]};
    if (shifts.first == Point{0, 0} && shifts.second == Point{0, 0}) return -1;
    shifts_.push_back(shifts);
    return static_cast<int>(shifts_.size()) - 1;
  }

  // Corners of a block move vertices within half a block around it. Others, at stones longer than that, go last.
  void list_corners() {
    if (!t_.half_side.empty()) block_ = kBlock * *std::max_element(t_.half_side.begin(), t_.half_side.end());
    std::map<std::pair<int, int>, std::vector<Corner>> blocks;
    for (int cell = 0; cell < map_.cells(); ++cell) {
      for (int slot = map_.first[cell]; slot < map_.first[cell + 1]; ++slot) {
        const int v = map_.ring[slot];
        nodes_[v].slide = std::min<double>(nodes_[v].slide, kSlide * t_.half_side[cell]);
        if (t_.freedom[v] != Freedom::kFree) continue;
        const int previous = map_.previous(cell, slot), next = map_.next(cell, slot);
        const int before = map_.ring[previous], after = map_.ring[next];
        const Corner corner{v, before, after, shifts_of(slot, previous, next), flat_[slot] != 0};
        (is_near(v, before) && is_near(v, after) ? blocks[block_of(v)] : far_).push_back(corner);
      }
    }
    for (auto& [block, corners] : blocks)
      blocks_[2 * (block.first & 1) + (block.second & 1)].push_back(std::move(corners));
  }

  bool is_near(int a, int b) const {
    const Point way = nodes_[a].begin - nodes_[b].begin;
    return std::max(std::fabs(way.x), std::fabs(way.y)) < 0.5 * block_;
  }

  std::pair<int, int> block_of(int vertex) const {
    const Point p = nodes_[vertex].begin;
    return {static_cast<int>(std::floor((p.y + params_.origin.y) / block_)),
            static_cast<int>(std::floor((p.x + params_.origin.x) / block_))};
  }

  void straighten(const Corner& corner) {
    Node &v = nodes_[corner.vertex], &a = nodes_[corner.before], &b = nodes_[corner.after];
    Point from = a.p, to = b.p;
    if (corner.shifts >= 0) from += shifts_[corner.shifts].first, to += shifts_[corner.shifts].second;
    const Point way = to - from;
    const double size2 = dot(way, way);
    if (size2 < 1e-12) return;
    const double off = cross(way, v.p - from);  // positive: hollow, clockwise rings with y down
    if (!corner.flat && off <= 0) return;
    const double along = std::clamp(dot(v.p - from, way) / size2, kMargin, 1 - kMargin);
    const Point error = v.p - (from + along * way);
    const double wa = a.mobility * (1 - along), wb = b.mobility * along;
    const double total = 1 + wa * (1 - along) + wb * along;
    move(v, (-1 / total) * error);
    move(a, (wa / total) * error);
    move(b, (wb / total) * error);
  }

  Tessellation& t_;
  PlanarMap& map_;
  const std::vector<char>& flat_;
  const RelaxParams& params_;
  std::vector<Node> nodes_;
  double block_ = 1;                            // side
  std::vector<std::vector<Corner>> blocks_[4];  // those of even rows and columns, of even rows and odd columns, ...
  std::vector<Corner> far_;
  std::vector<std::pair<Point, Point>> shifts_;
  // Of square_up(): how each slot's corner shall move, their sum and number for each vertex.
  std::vector<Point> way_, pull_;
  std::vector<int> pulls_;
};

}  // namespace

void relax(Tessellation& t, std::vector<char>& flat, const Back& back, const RelaxParams& params,
           const std::vector<Pin>& pins) {
  Relaxer relaxer(t, flat, params);
  for (int i = 0; i < params.rounds; ++i) {
    if (!t.frame.empty() && i < params.rounds * 5 / 6)
      relaxer.square_up(params.squareness * (1 - 1.2 * i / params.rounds));
    relaxer.round(i < params.rounds / 2 ? params.pull : 0);
    if (i == params.rounds / 2) relaxer.back_to_frontier(back);
  }
  relaxer.back_to_frontier(back);
  relaxer.pin(pins);
  relaxer.apply();
  relaxer.untangle(flat);
}

}  // namespace tessera
