#include "tessera/patterns/clip.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace tessera::patterns {
namespace {

// One side of the window: points with sign * (coordinate - at) > 0 are outside.
struct Limit {
  double Point::*coordinate;
  double Point::*along;
  double at, sign;

  bool outside(Point p) const { return sign * (p.*coordinate - at) > 0; }
  // Where the side from an inner to an outer point crosses. The order is always that, so that both cells at this side
  // find the same.
  Point crossing(Point inner, Point outer) const {
    const double share = (at - inner.*coordinate) / (outer.*coordinate - inner.*coordinate);
    Point p = inner + share * (outer - inner);
    p.*coordinate = at;
    return p;
  }
};

// A stretch of a ring inside of a limit, from where it comes in to where it goes out.
struct Chain {
  Ring points;
  bool done = false;
};

// The ring begins outside.
std::vector<Chain> chains_inside(const Ring& ring, const Limit& limit) {
  std::vector<Chain> chains;
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = ring[i], b = ring[i + 1 < n ? i + 1 : 0];
    const bool a_out = limit.outside(a), b_out = limit.outside(b);
    if (a_out && !b_out) chains.push_back({{limit.crossing(b, a)}});
    if (!b_out) chains.back().points.push_back(b);
    if (!a_out && b_out) chains.back().points.push_back(limit.crossing(a, b));
  }
  return chains;
}

// Along the limit the ring's inside is between the first crossing and the second, the third and the fourth. A chain
// that goes out at one of a pair is followed by the one that comes in at the other.
std::vector<Ring> joined(std::vector<Chain> chains, const Limit& limit) {
  struct Crossing {
    double along;
    std::size_t chain;
    bool is_end;
  };
  std::vector<Crossing> crossings;
  for (std::size_t c = 0; c < chains.size(); ++c) {
    crossings.push_back({chains[c].points.front().*limit.along, c, false});
    crossings.push_back({chains[c].points.back().*limit.along, c, true});
  }
  std::stable_sort(crossings.begin(), crossings.end(),
                   [](const Crossing& a, const Crossing& b) { return a.along < b.along; });
  std::vector<std::size_t> follower(chains.size());
  for (std::size_t c = 0; c < chains.size(); ++c) follower[c] = c;
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
    const Crossing &a = crossings[k], &b = crossings[k + 1];
    if (a.is_end != b.is_end) (a.is_end ? follower[a.chain] : follower[b.chain]) = a.is_end ? b.chain : a.chain;
  }
  std::vector<Ring> rings;
  for (std::size_t first = 0; first < chains.size(); ++first) {
    Ring ring;
    for (std::size_t c = first; !chains[c].done; c = follower[c]) {
      chains[c].done = true;
      ring.insert(ring.end(), chains[c].points.begin(), chains[c].points.end());
    }
    if (!ring.empty()) rings.push_back(std::move(ring));
  }
  return rings;
}

void cut(std::vector<Ring>& rings, const Limit& limit) {
  std::vector<Ring> kept;
  for (Ring& ring : rings) {
    const auto outer = std::find_if(ring.begin(), ring.end(), [&](Point p) { return limit.outside(p); });
    if (outer == ring.end()) {
      kept.push_back(std::move(ring));
      continue;
    }
    std::rotate(ring.begin(), outer, ring.end());
    for (Ring& part : joined(chains_inside(ring, limit), limit)) kept.push_back(std::move(part));
  }
  rings = std::move(kept);
}

Ring without_repeats(Ring ring) {
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

}  // namespace

void append_within(const Window& window, Ring ring, Cells& cells) {
  const Limit limits[] = {{&Point::x, &Point::y, window.low.x, -1},
                          {&Point::x, &Point::y, window.high.x, 1},
                          {&Point::y, &Point::x, window.low.y, -1},
                          {&Point::y, &Point::x, window.high.y, 1}};
  const bool is_cut = std::any_of(std::begin(limits), std::end(limits), [&](const Limit& limit) {
    return std::any_of(ring.begin(), ring.end(), [&](Point p) { return limit.outside(p); });
  });
  if (!is_cut) {
    cells.push_back(std::move(ring));
    return;
  }
  std::vector<Ring> rings;
  rings.push_back(std::move(ring));
  for (const Limit& limit : limits) cut(rings, limit);
  for (Ring& part : rings) {
    part = without_repeats(std::move(part));
    if (part.size() >= 3 && signed_area(part) > 0) cells.push_back(std::move(part));
  }
}

}  // namespace tessera::patterns
