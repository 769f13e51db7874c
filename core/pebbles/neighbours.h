// Pixels beside pixels, and parts of labels that hang together.
#pragma once

#include <opencv2/core.hpp>

namespace tessera::pebbles {

// Calls visit(y, x) for the up to four neighbours of a pixel.
template <class Visit>
void each_neighbour(const cv::Mat& map, int y, int x, Visit&& visit) {
  if (y > 0) visit(y - 1, x);
  if (x > 0) visit(y, x - 1);
  if (x + 1 < map.cols) visit(y, x + 1);
  if (y + 1 < map.rows) visit(y + 1, x);
}

// 0 where there is none.
int largest_label(const cv::Mat1i& labels);

// Of each label 1 to `count` the largest 4-connected part stays, the first among equals; the others become ground, 0.
void keep_largest_parts(cv::Mat1i& labels, int count);

}  // namespace tessera::pebbles
