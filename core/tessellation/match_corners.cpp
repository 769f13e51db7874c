#include "tessera/tessellation/match_corners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <opencv2/core/utility.hpp>
#include <queue>

namespace tessera {
namespace {

// What a curved frontier may deviate under one stone's straight side, in h: where the stone falls short of it there
// is wider grout, where it goes beyond it covers the other colour.
constexpr double kFrontierShort = 0.2, kFrontierBeyond = 0.12;
constexpr double kSquareness = 0.25;  // weight of right angles against distances moved (in h, squared)
constexpr double kAlignment = 4;      // weight of sides along the cell's frame, if it has one
constexpr double kTooFar = 1.2;       // largest rise of a stone's badness that one flat angle may cost
constexpr double kChange = 0.01;      // least cost of a link in a chain of changes
constexpr int kLongestChain = 8;      // links: what is farther away has no say in a cell's flat angles
constexpr int kLargestCell = 24;      // vertices of a cell; larger ones stay as they are

// A flat angle that may be: at `vertex`, for `cell`.
struct Candidate {
  int slot, cell, vertex;
};

class Matcher {
 public:
  explicit Matcher(const Tessellation& t) : t_(t), map_(t.map) {
    flat_.assign(map_.ring.size(), 0);
    owner_.assign(map_.vertices.size(), -1);
    spare_.resize(map_.cells());
    for (int c = 0; c < map_.cells(); ++c)
      spare_[c] = map_.corners(c) > kLargestCell ? 0 : std::max(0, map_.corners(c) - 4);
    find_candidates();
  }

  std::vector<char> run() {
    cheapest_first();
    for (int cell = 0; cell < map_.cells(); ++cell)
      while (spare_[cell] > 0 && augment(cell)) {
      }
    return std::move(flat_);
  }

 private:
  void find_candidates() {
    std::vector<std::array<int, 3>> slots(map_.vertices.size(), {-1, -1, -1});
    std::vector<int> cell_of(map_.ring.size()), degree(map_.vertices.size(), 0);
    for (int c = 0; c < map_.cells(); ++c) {
      for (int s = map_.first[c]; s < map_.first[c + 1]; ++s) {
        cell_of[s] = c;
        const int v = map_.ring[s];
        if (degree[v] < 3) slots[v][degree[v]] = s;
        ++degree[v];
      }
    }
    candidate_at_.assign(map_.ring.size(), 0);
    for (std::size_t v = 0; v < slots.size(); ++v) {
      if (degree[v] != 3) continue;  // four stones' corners are all square, two stones' vertex is a bend
      const auto zone = [&](int k) { return t_.zone[cell_of[slots[v][k]]]; };
      const bool one_zone = zone(0) == zone(1) && zone(1) == zone(2);
      for (int k = 0; k < 3; ++k) {
        const int slot = slots[v][k];
        if (one_zone) {
          candidate_at_[slot] = 1;
        } else if (zone(k) != zone((k + 1) % 3) && zone((k + 1) % 3) == zone((k + 2) % 3)) {
          flatten_on_frontier({slot, cell_of[slot], static_cast<int>(v)});
        }
      }
    }
    cell_of_ = std::move(cell_of);
  }

  // On a frontier the stone that is alone in its zone has its straight side there: no choice, unless it bends.
  void flatten_on_frontier(const Candidate& c) {
    const Point p = map_.at(c.slot), a = map_.at(map_.previous(c.cell, c.slot)),
                b = map_.at(map_.next(c.cell, c.slot));
    const double size = length(b - a);
    if (spare_[c.cell] == 0 || size == 0) return;
    const double hollow = cross(b - a, p - a) / (size * t_.half_side[c.cell]);
    if (hollow <= kFrontierBeyond && hollow >= -kFrontierShort) take(c);
  }

  // How far a cell is from a stone when its flat angles, `lost` no more and `gained` too, are flattened: squared
  // distances of the flat vertices from their sides, and how far its corners are from right angles.
  double badness(int cell, int lost, int gained) const {
    Point corner[kLargestCell];
    int slot_of[kLargestCell], n = 0;
    const int first = map_.first[cell], end = map_.first[cell + 1];
    for (int s = first; s < end; ++s) {
      if ((flat_[s] && s != lost) || s == gained) continue;
      corner[n] = map_.at(s);
      slot_of[n++] = s;
    }
    Point way[kLargestCell];
    double inverse[kLargestCell];  // of the sides' lengths
    for (int i = 0; i < n; ++i) {
      way[i] = corner[i + 1 < n ? i + 1 : 0] - corner[i];
      const double size = length(way[i]);
      inverse[i] = size > 0 ? 1 / size : 0;
    }
    const double h = t_.half_side[cell];
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      const int last = i > 0 ? i - 1 : n - 1, next = i + 1 < n ? i + 1 : 0;
      const double square = cross(way[last], way[i]) * (inverse[last] * inverse[i]);
      sum += kSquareness * (1 - square) * (1 - square);
      if (!t_.frame.empty()) {
        // Sine of twice the angle between the side and the frame's axis next to it.
        const Point axis = t_.frame[cell];
        const double askew = 2 * dot(way[i], axis) * cross(way[i], axis) * inverse[i] * inverse[i];
        sum += kAlignment * askew * askew;
      }
      for (int s = map_.next(cell, slot_of[i]); s != slot_of[next]; s = map_.next(cell, s)) {
        const double off = cross(way[i], map_.at(s) - corner[i]) * (inverse[i] / h);
        sum += off * off;
      }
    }
    return sum;
  }

  bool free_candidate(int slot) const { return candidate_at_[slot] && !flat_[slot]; }

  void take(const Candidate& c) {
    flat_[c.slot] = 1;
    owner_[c.vertex] = c.slot;
    --spare_[c.cell];
  }

  // The flat angle that improves its stone most, or harms it least, among all stones; then that stone is looked at
  // anew.
  void cheapest_first() {
    cost_.resize(map_.ring.size());
    cv::parallel_for_({0, map_.cells()}, [&](const cv::Range& range) {
      for (int cell = range.start; cell < range.end; ++cell) weigh(cell);
    });
    std::vector<Entry> entries;
    for (int cell = 0; cell < map_.cells(); ++cell) {
      if (const int slot = cheapest(cell); slot >= 0) entries.push_back({cost_[slot], slot});
    }
    std::priority_queue<Entry> queue({}, std::move(entries));
    while (!queue.empty()) {
      const int slot = queue.top().slot, cell = cell_of_[slot];
      queue.pop();
      if (owner_[map_.ring[slot]] < 0) {
        take({slot, cell, map_.ring[slot]});
        weigh(cell);
      }
      if (const int next = cheapest(cell); next >= 0) queue.push({cost_[next], next});
    }
  }

  // A cell's cheapest candidate; each cell has one in the queue at most.
  struct Entry {
    double cost;
    int slot;
    bool operator<(const Entry& other) const { return cost != other.cost ? cost > other.cost : slot > other.slot; }
  };

  void weigh(int cell) {
    if (spare_[cell] == 0) return;
    const double now = badness(cell, -1, -1);
    for (int s = map_.first[cell]; s < map_.first[cell + 1]; ++s)
      if (free_candidate(s)) cost_[s] = badness(cell, -1, s) - now;
  }

  int cheapest(int cell) const {
    int best = -1;
    if (spare_[cell] == 0) return best;
    for (int s = map_.first[cell]; s < map_.first[cell + 1]; ++s) {
      if (!free_candidate(s) || owner_[map_.ring[s]] >= 0 || cost_[s] > kTooFar) continue;
      if (best < 0 || cost_[s] < cost_[best]) best = s;
    }
    return best;
  }

  // A link of a chain: `gained` becomes flat in its cell, which lost `lost` (-1 at the start) to the link before.
  struct Link {
    double cost;
    int gained, lost, before, length;
  };

  // Cheapest chain by which `start` gets one more flat angle: it takes one from a stone, which takes one from
  // another, until a vertex that was no stone's. Returns whether there was one.
  bool augment(int start) {
    links_.clear();
    open_.clear();
    lost_.clear();
    expand(start, -1, -1, 0);
    while (!open_.empty()) {
      const int at = open_.front().second;
      std::pop_heap(open_.begin(), open_.end(), std::greater<>());
      open_.pop_back();
      const Link link = links_[at];
      const int held = owner_[map_.ring[link.gained]];
      if (held < 0) {
        flip(at);
        --spare_[start];
        return true;
      }
      if (link.length == kLongestChain || !candidate_at_[held]) continue;
      if (std::find(lost_.begin(), lost_.end(), held) != lost_.end()) continue;
      const int cell = cell_of_[held];
      if (in_chain(at, cell)) continue;
      lost_.push_back(held);
      expand(cell, held, at, link.cost);
    }
    return false;
  }

  // Opens the links by which a cell that loses one flat angle (-1: none) gains another.
  void expand(int cell, int lost, int before, double cost) {
    const double now = badness(cell, -1, -1);
    const int length = before < 0 ? 1 : links_[before].length + 1;
    for (int s = map_.first[cell]; s < map_.first[cell + 1]; ++s) {
      if (!free_candidate(s) || s == lost) continue;
      const double step = badness(cell, lost, s) - now;
      if (step > kTooFar) continue;
      open_.push_back({cost + std::max(kChange, step), static_cast<int>(links_.size())});
      std::push_heap(open_.begin(), open_.end(), std::greater<>());
      links_.push_back({cost + std::max(kChange, step), s, lost, before, length});
    }
  }

  bool in_chain(int at, int cell) const {
    for (; at >= 0; at = links_[at].before)
      if (cell_of_[links_[at].gained] == cell) return true;
    return false;
  }

  void flip(int at) {
    for (; at >= 0; at = links_[at].before) {
      const int slot = links_[at].gained, vertex = map_.ring[slot];
      if (owner_[vertex] >= 0) flat_[owner_[vertex]] = 0;
      flat_[slot] = 1;
      owner_[vertex] = slot;
    }
  }

  const Tessellation& t_;
  const PlanarMap& map_;
  std::vector<char> flat_, candidate_at_;  // one a slot
  std::vector<int> owner_;                 // slot at which a vertex is flat, -1: none
  std::vector<int> spare_;                 // vertices of a cell above four that are corners still
  std::vector<int> cell_of_;               // of a slot
  // Of one search, kept for their memory: links, those not looked at yet by cost (a heap), and the slots lost so far.
  std::vector<Link> links_;
  std::vector<std::pair<double, int>> open_;
  std::vector<int> lost_;
  std::vector<double> cost_;  // of a candidate, while its cell's flat angles stay as they are
};

}  // namespace

std::vector<char> match_corners(const Tessellation& t) { return Matcher(t).run(); }

}  // namespace tessera
