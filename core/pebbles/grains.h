// Sizes of grains, as field science states them.
#pragma once

#include <vector>

#include "tessera/pebbles/pebble.h"

namespace tessera::pebbles {

// Of the ellipse with an outline's second moments and its area, in source pixels.
struct Grain {
  double a = 0, b = 0;         // longer and shorter axis (diameters)
  double orientation_deg = 0;  // of the longer one, [0, 180), from x towards y
  double area = 0;             // inside the outline
};

std::vector<Grain> measure_grains(const std::vector<Pebble>& pebbles);

// The size that the given share (0..1) of the values does not exceed, linear between the middles of the sorted ones;
// 0 where there are none.
double percentile(std::vector<double> values, double share);

}  // namespace tessera::pebbles
