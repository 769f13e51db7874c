// The watershed of a strength map: a basin for each of its valleys.
#pragma once

#include <opencv2/core.hpp>

namespace tessera::pebbles {

struct Basins {
  cv::Mat1i labels;  // 0 to count - 1, of each pixel
  int count = 0;
};

// From each pixel water runs to the lowest of its four neighbours, equal ones to the first in reading order; where it
// ends is a basin. Basins less than `depth` deep then join the neighbour over which they first spill, the shallower
// one the deeper (their dynamics: Grimaud 1992).
Basins watershed(const cv::Mat1w& strength, int depth);

}  // namespace tessera::pebbles
