// The Poisson line model (3.2 a).
#pragma once

#include "tessera/base/rng.h"
#include "tessera/patterns/clip.h"

namespace tessera::patterns {

// x cos theta + y sin theta = p about the window's centre.
struct Line {
  double theta, p;  // theta in [0, pi), radians
};

// The lines of a Poisson process of that intensity in (theta, p) that cross the window.
std::vector<Line> poisson_lines(const Window& window, double intensity, Rng& rng);
// Lines that close upon themselves in a periodic window, about as long together as those of poisson_lines(): each
// goes the way of a whole number of windows across and down.
std::vector<Line> closed_lines(const Window& window, double intensity, Rng& rng);

// The cells into which the lines cut the window. O(n^2 log n) for n lines, which is n log n for the cells.
Cells line_cells(const std::vector<Line>& lines, const Window& window);

}  // namespace tessera::patterns
