// Pebbles strewn anew: at points of a process, those that have room for them.
#pragma once

#include <cstdint>
#include <vector>

#include "tessera/geometry/point.h"
#include "tessera/pebbles/params.h"
#include "tessera/pebbles/pebble.h"

namespace tessera::pebbles {

// At most `count` of the pebbles, at random, in their order: those that are strewn.
std::vector<Pebble> prototypes(const std::vector<Pebble>& pebbles, int count, std::uint64_t seed);

struct Throw {
  std::size_t stone = 0;  // which of them
  Point place;            // metres from the middle of the field
  double turn = 0;        // radians around the upward axis
  double scale = 1;
};

struct Strewn {
  Point size;  // of the field, metres
  std::vector<Throw> throws;
};

// `count` throws of stones of the given radii (metres, > 0) on a field of `size` (metres, centred), larger in the
// same proportion where that has not room enough. No two overlap, nor would they if the field went on at its other
// side: copies of it side by side have no seams.
Strewn strew(const std::vector<double>& radii, int count, Point size, Strewing strewing, std::uint64_t seed);

}  // namespace tessera::pebbles
