// How much each pixel looks like the border of a pebble.
#pragma once

#include <opencv2/core.hpp>

namespace tessera::pebbles {

// 16 to a level of `lab` (image/lab.h), of its size: colour's gradient at two scales, and how far a pixel lies in a
// dark gap.
cv::Mat1w border_strength(const cv::Mat3b& lab);

}  // namespace tessera::pebbles
