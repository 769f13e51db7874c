#include "tessera/patterns/lattice_cells.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tessera/base/portable_math.h"
#include "tessera/geometry/angle.h"

namespace tessera::patterns {
namespace {

// Where whole numbers (i, j) lie: origin + i u + j v.
struct Frame {
  Point origin, u, v;

  Point at(int i, int j) const { return origin + static_cast<double>(i) * u + static_cast<double>(j) * v; }
};

// A lattice's cells in whole numbers of its frame: corners about cell (0, 0), whose copies are `right` and `down` of
// it.
struct Step {
  int i, j;
};
struct Pattern {
  Point u, v;  // of the frame, for a side of 1
  Step right, down;
  std::vector<std::vector<Step>> cells;  // clockwise on the screen
};

Pattern pattern_of(Lattice lattice) {
  const double half = 0.5, high = std::sqrt(3.0) / 2;
  switch (lattice) {
    case Lattice::kSquares: return {{1, 0}, {0, 1}, {1, 0}, {0, 1}, {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}};
    case Lattice::kHexagons:
      return {{half, 0}, {0, high}, {3, 1}, {0, 2}, {{{2, 0}, {1, 1}, {-1, 1}, {-2, 0}, {-1, -1}, {1, -1}}}};
    case Lattice::kTriangles: break;
  }
  return {{half, 0}, {0, high}, {2, 0}, {1, 1}, {{{0, 0}, {2, 0}, {1, 1}}, {{2, 0}, {3, 1}, {1, 1}}}};
}

Frame random_frame(const Pattern& pattern, double side, const Window& window, Rng& rng) {
  const Angle angle = Angle::of(rng.uniform(0, 2 * kPi));
  Frame frame{{}, angle.turned(side * pattern.u), angle.turned(side * pattern.v)};
  // Anywhere between neighbouring copies.
  const Point right = frame.at(pattern.right.i, pattern.right.j), down = frame.at(pattern.down.i, pattern.down.j);
  const double a = rng.uniform(), b = rng.uniform();
  frame.origin = 0.5 * (window.low + window.high) + a * right + b * down;
  return frame;
}

// Whole steps r, d with r right + d down = way, nearly.
struct Steps {
  double right, down;
};
Steps steps_to(Point way, Point right, Point down) {
  const double area = cross(right, down);
  return {cross(way, down) / area, cross(right, way) / area};
}

// Bends the frame so that the window's width and height are whole numbers of steps.
void close(Frame& frame, const Pattern& pattern, const Window& window) {
  const Point zero = frame.origin;
  frame.origin = {};
  const Point right = frame.at(pattern.right.i, pattern.right.j), down = frame.at(pattern.down.i, pattern.down.j);
  const Point size = window.size();
  const auto whole = [&](Point way) {
    const Steps s = steps_to(way, right, down);
    return Steps{std::round(s.right), std::round(s.down)};
  };
  Steps across = whole({size.x, 0}), below = whole({0, size.y});
  double cells = across.right * below.down - across.down * below.right;
  if (cells < 0.5) {  // the window is smaller than a cell
    const double sign = cross(right, down) > 0 ? 1 : -1;
    across = {1, 0}, below = {0, sign}, cells = sign;
  }
  // [right down] [across below] = [width 0; 0 height], solved for right and down.
  const Point new_right{size.x * below.down / cells, -size.y * across.down / cells};
  const Point new_down{-size.x * below.right / cells, size.y * across.right / cells};
  // u and v from right = i u + j v and down likewise.
  const double det = pattern.right.i * pattern.down.j - pattern.right.j * pattern.down.i;
  frame.u =
      (1 / det) * (static_cast<double>(pattern.down.j) * new_right - static_cast<double>(pattern.right.j) * new_down);
  frame.v =
      (1 / det) * (static_cast<double>(pattern.right.i) * new_down - static_cast<double>(pattern.down.i) * new_right);
  frame.origin = zero;
}

}  // namespace

Cells lattice_cells(Lattice lattice, double side, const Window& window, Rng& rng) {
  Cells cells;
  if (window.area() <= 0) return cells;
  const Pattern pattern = pattern_of(lattice);
  Frame frame = random_frame(pattern, side, window, rng);
  if (window.periodic) close(frame, pattern, window);
  const Point right = frame.at(pattern.right.i, pattern.right.j) - frame.origin;
  const Point down = frame.at(pattern.down.i, pattern.down.j) - frame.origin;
  double least_r = 1e300, most_r = -1e300, least_d = 1e300, most_d = -1e300;
  for (const Point corner :
       {window.low, window.high, Point{window.low.x, window.high.y}, Point{window.high.x, window.low.y}}) {
    const Steps s = steps_to(corner - frame.origin, right, down);
    least_r = std::min(least_r, s.right), most_r = std::max(most_r, s.right);
    least_d = std::min(least_d, s.down), most_d = std::max(most_d, s.down);
  }
  constexpr int kAround = 2;  // steps: a cell's corners are no farther from its copy's place
  for (int d = static_cast<int>(std::floor(least_d)) - kAround; d <= most_d + kAround; ++d)
    for (int r = static_cast<int>(std::floor(least_r)) - kAround; r <= most_r + kAround; ++r)
      for (const std::vector<Step>& corners : pattern.cells) {
        const int i = r * pattern.right.i + d * pattern.down.i, j = r * pattern.right.j + d * pattern.down.j;
        Ring ring;
        for (const Step corner : corners) ring.push_back(frame.at(i + corner.i, j + corner.j));
        if (!window.periodic)
          append_within(window, std::move(ring), cells);
        else if (window.holds(centroid(ring)))
          cells.push_back(std::move(ring));
      }
  return cells;
}

Cells pixel_cells(const Window& window) {
  Cells cells;
  for (double y = window.low.y; y < window.high.y; ++y)
    for (double x = window.low.x; x < window.high.x; ++x) {
      const double right = std::min(x + 1, window.high.x), bottom = std::min(y + 1, window.high.y);
      cells.push_back({{x, y}, {right, y}, {right, bottom}, {x, bottom}});
    }
  return cells;
}

}  // namespace tessera::patterns
