#include "tessera/patterns/line_cells.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "tessera/base/distributions.h"
#include "tessera/base/portable_math.h"

namespace tessera::patterns {
namespace {

constexpr int kMostTurns = 3;  // of a closed line about the window, either way

// A line as it crosses the window: origin + t way, begin < t < end.
struct Chord {
  Point origin, way;
  double begin = 0, end = 0;
};

// False where it misses the window.
bool find_chord(const Line& line, const Window& window, Chord& chord) {
  const SinCos turn = sin_cos(line.theta);
  const Point centre = 0.5 * (window.low + window.high);
  chord = {centre + line.p * Point{turn.cos, turn.sin}, {-turn.sin, turn.cos}, -1e300, 1e300};
  const auto limit = [&](double origin, double way, double low, double high) {
    if (way == 0) {
      if (origin <= low || origin >= high) chord.end = -1e300;
      return;
    }
    const double a = (low - origin) / way, b = (high - origin) / way;
    chord.begin = std::max(chord.begin, std::min(a, b));
    chord.end = std::min(chord.end, std::max(a, b));
  };
  limit(chord.origin.x, chord.way.x, window.low.x, window.high.x);
  limit(chord.origin.y, chord.way.y, window.low.y, window.high.y);
  return chord.begin < chord.end;
}

// The arrangement of chords and the window's border as a graph. Tracks are the chords and, as the last, the border,
// which runs clockwise on the screen and is closed. Each node lies on two tracks, but for the corners.
class Arrangement {
 public:
  Arrangement(const std::vector<Chord>& chords, const Window& window) : chords_(chords), tracks_(chords.size() + 1) {
    cross_chords();
    meet_border(window);
    for (std::size_t t = 0; t < tracks_.size(); ++t) number_track(t);
  }

  // Walks about each face, always turning as far right as it goes.
  Cells faces() {
    Cells cells;
    std::vector<std::size_t> offset(tracks_.size() + 1, 0);
    for (std::size_t t = 0; t < tracks_.size(); ++t) offset[t + 1] = offset[t] + tracks_[t].size();
    std::vector<bool> walked(2 * offset.back(), false);
    for (std::size_t t = 0; t < tracks_.size(); ++t)
      for (std::size_t k = 0; k < tracks_[t].size(); ++k)
        for (const bool forward : {true, false}) {
          if (!is_side({t, k, forward})) continue;
          Ring ring;
          for (Side side{t, k, forward};;) {
            auto&& done = walked[2 * (offset[side.track] + side.at) + (side.forward ? 1 : 0)];
            if (done) break;
            done = true;
            const std::size_t node = tracks_[side.track][end_of(side)].node;
            ring.push_back(nodes_[node].place);
            side = next(side);
          }
          if (ring.size() >= 3) cells.push_back(std::move(ring));
        }
    return cells;
  }

 private:
  struct Node {
    Point place;
    std::size_t track[2], at[2];  // where it lies; a corner lies twice on the border
  };
  struct Stop {
    double t;  // along the track
    std::size_t node;
  };
  // From a stop of a track to the next one, or to the one before.
  struct Side {
    std::size_t track, at;
    bool forward;
  };

  std::size_t border() const { return chords_.size(); }

  std::size_t add_node(Point place, std::size_t a, std::size_t b) {
    nodes_.push_back({place, {a, b}, {0, 0}});
    return nodes_.size() - 1;
  }

  void cross_chords() {
    for (std::size_t i = 0; i < chords_.size(); ++i)
      for (std::size_t k = i + 1; k < chords_.size(); ++k) {
        const Chord &a = chords_[i], &b = chords_[k];
        const double sine = cross(a.way, b.way);
        if (sine == 0) continue;
        const Point apart = b.origin - a.origin;
        const double t = cross(apart, b.way) / sine, u = cross(apart, a.way) / sine;
        if (!(a.begin < t && t < a.end && b.begin < u && u < b.end)) continue;
        const std::size_t node = add_node(a.origin + t * a.way, i, k);
        tracks_[i].push_back({t, node});
        tracks_[k].push_back({u, node});
      }
  }

  void meet_border(const Window& window) {
    const Point size = window.size();
    // Distance from the top left corner, clockwise on the screen. The place is put onto the border's side.
    const auto on_border = [&](Point& p) {
      const double gaps[] = {std::abs(p.y - window.low.y), std::abs(p.x - window.high.x),
                             std::abs(p.y - window.high.y), std::abs(p.x - window.low.x)};
      switch (std::min_element(gaps, gaps + 4) - gaps) {
        case 0: p.y = window.low.y; return p.x - window.low.x;
        case 1: p.x = window.high.x; return size.x + p.y - window.low.y;
        case 2: p.y = window.high.y; return size.x + size.y + window.high.x - p.x;
        default: p.x = window.low.x; return 2 * size.x + size.y + window.high.y - p.y;
      }
    };
    for (std::size_t i = 0; i < chords_.size(); ++i)
      for (const double t : {chords_[i].begin, chords_[i].end}) {
        Point place = chords_[i].origin + t * chords_[i].way;
        const double around = on_border(place);
        const std::size_t node = add_node(place, i, border());
        tracks_[i].push_back({t, node});
        tracks_[border()].push_back({around, node});
      }
    const Point corners[] = {window.low, {window.high.x, window.low.y}, window.high, {window.low.x, window.high.y}};
    const double places[] = {0, size.x, size.x + size.y, 2 * size.x + size.y};
    for (int c = 0; c < 4; ++c) tracks_[border()].push_back({places[c], add_node(corners[c], border(), border())});
  }

  void number_track(std::size_t t) {
    std::stable_sort(tracks_[t].begin(), tracks_[t].end(), [](const Stop& a, const Stop& b) { return a.t < b.t; });
    for (std::size_t k = 0; k < tracks_[t].size(); ++k) {
      Node& node = nodes_[tracks_[t][k].node];
      for (int side = 0; side < 2; ++side)
        if (node.track[side] == t) node.at[side] = k;
    }
  }

  // The border is walked one way only: there is no cell outside.
  bool is_side(const Side& side) const {
    if (side.track == border()) return side.forward;
    return side.forward ? side.at + 1 < tracks_[side.track].size() : side.at > 0;
  }

  std::size_t end_of(const Side& side) const {
    const std::size_t n = tracks_[side.track].size();
    return side.forward ? (side.at + 1) % n : side.at - 1;
  }

  Side next(const Side& side) const {
    const std::size_t at = end_of(side);
    const Node& node = nodes_[tracks_[side.track][at].node];
    if (node.track[0] == node.track[1]) return {border(), at, true};  // a corner
    const int other = node.track[0] == side.track ? 1 : 0;
    const std::size_t track = node.track[other], place = node.at[other];
    if (track == border()) return {track, place, true};
    if (side.track == border()) return {track, place, place == 0};  // into the window
    const double turn = cross(chords_[side.track].way, chords_[track].way);
    return {track, place, (turn > 0) == side.forward};
  }

  const std::vector<Chord>& chords_;
  std::vector<Node> nodes_;
  std::vector<std::vector<Stop>> tracks_;
};

Cells cells_in(const std::vector<Line>& lines, const Window& window) {
  std::vector<Chord> chords;
  for (const Line& line : lines)
    if (Chord chord; find_chord(line, window, chord)) chords.push_back(chord);
  return Arrangement(chords, window).faces();
}

bool touches_border(const Ring& ring, const Window& window) {
  return std::any_of(ring.begin(), ring.end(), [&](Point p) {
    return p.x == window.low.x || p.x == window.high.x || p.y == window.low.y || p.y == window.high.y;
  });
}

// The cells whose centres lie in a periodic window, whole. False where the margin cuts one of them.
bool whole_cells(const std::vector<Line>& lines, const Window& window, const Window& realm, Cells& cells) {
  for (Ring& ring : cells_in(lines, realm)) {
    if (!window.holds(centroid(ring))) continue;
    if (touches_border(ring, realm)) return false;
    cells.push_back(std::move(ring));
  }
  return true;
}

// Across and down, in whole windows, about as the line goes; never (0, 0).
Point closed_way(Point way, Point size) {
  Point best;
  double least = 2;
  for (int a = -kMostTurns; a <= kMostTurns; ++a)
    for (int b = 0; b <= kMostTurns; ++b) {
      if (std::gcd(a, b) != 1) continue;
      const Point other{a * size.x, b * size.y};
      const double sine = std::abs(cross(way, other)) / length(other);
      if (sine < least) least = sine, best = other;
    }
  return best;
}

}  // namespace

std::vector<Line> poisson_lines(const Window& window, double intensity, Rng& rng) {
  // All lines that meet the circle about the window; those that miss the window are no loss.
  const double radius = length(window.size()) / 2;
  std::vector<Line> lines;
  for (std::int64_t n = draw_poisson(intensity * kPi * 2 * radius, rng); n > 0; --n) {
    Line line{};
    line.theta = rng.uniform(0, kPi);
    line.p = rng.uniform(-radius, radius);
    if (Chord chord; find_chord(line, window, chord)) lines.push_back(line);
  }
  return lines;
}

std::vector<Line> closed_lines(const Window& window, double intensity, Rng& rng) {
  const Point size = window.size();
  // Also those of the windows around it, which cells at its border need.
  const double reach = 3 * length(size);
  double rest = kPi * intensity * window.area();  // of the length of all lines in the window
  std::vector<Line> lines;
  while (rest > 0) {
    const SinCos turn = sin_cos(rng.uniform(0, kPi));
    const Point way = closed_way({-turn.sin, turn.cos}, size);
    const double whole = length(way), offset = rng.uniform(), taken = rng.uniform();
    if (rest < whole && taken * whole > rest) break;
    rest -= whole;
    double theta = atan2_portable(-way.x, way.y);  // of the normal
    if (theta < 0) theta += kPi;
    const double spacing = window.area() / whole;
    for (double p = (offset - 1) * spacing - std::floor(reach / spacing) * spacing; p <= reach; p += spacing)
      lines.push_back({theta, p});
  }
  return lines;
}

Cells line_cells(const std::vector<Line>& lines, const Window& window) {
  if (window.area() <= 0) return {};
  if (!window.periodic) return cells_in(lines, window);
  for (const double margin : {0.5, 1.0, 2.0}) {
    Cells cells;
    if (whole_cells(lines, window, window.grown(margin * length(window.size())), cells)) return cells;
  }
  return cells_in(lines, window);  // too few lines to bound each cell
}

}  // namespace tessera::patterns
