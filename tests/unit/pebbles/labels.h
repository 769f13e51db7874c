// Label maps and random pictures made in code.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "tessera/base/rng.h"

namespace tessera::pebbles {

// Uniform in 0 to end - 1.
inline int below(Rng& rng, int end) { return static_cast<int>(rng.bits() % static_cast<std::uint32_t>(end)); }

// A digit a pixel.
inline cv::Mat1i labels_of(const std::vector<std::string>& rows) {
  cv::Mat1i labels(static_cast<int>(rows.size()), static_cast<int>(rows[0].size()));
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) labels(y, x) = rows[y][x] - '0';
  return labels;
}

inline int pixels_of(const cv::Mat1i& labels, int label) { return cv::countNonZero(labels == label); }

}  // namespace tessera::pebbles
