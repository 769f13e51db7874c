// The watershed of a strength map: a basin for each of its valleys.
#pragma once

#include <opencv2/core.hpp>

namespace tessera::pebbles {

struct Basins {
  cv::Mat1i labels;  // 0 to count - 1, of each pixel
  int count = 0;
};

// Immersion (Vincent and Soille 1991), lowest pixels first, without pixels for the dams; basins less than `depth`
// deep flow into the neighbour over which they first spill. 4-connected.
Basins watershed(const cv::Mat1w& strength, int depth);

}  // namespace tessera::pebbles
