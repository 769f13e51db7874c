// The Johnson-Mehl model (3.2 b): nuclei come in the course of time and grow as circles until they meet.
#pragma once

#include <vector>

#include "tessera/base/rng.h"
#include "tessera/base/run_context.h"
#include "tessera/patterns/clip.h"

namespace tessera::patterns {

struct Nucleus {
  Point place;
  double head_start;  // how far a circle would have grown before it came, speed * time, px
};

// Nuclei of a Poisson process in space and time, of intensity rate / speed an area and length of growth, that found
// their place free: those that matter to cells in the window. Of a periodic window those in it.
std::vector<Nucleus> grow_nuclei(const Window& window, double rate_by_speed, Rng& rng);

// Their cells. Borders are arcs of hyperbolas, whose chords are no farther from them than `tolerance`, px. The window
// cuts cells; those of a periodic one stick out. Takes what grow_nuclei() gives; O(n) for n nuclei.
Result<Cells> johnson_mehl_cells(const std::vector<Nucleus>& nuclei, const Window& window, double rate_by_speed,
                                 double tolerance, const RunContext& context);

}  // namespace tessera::patterns
