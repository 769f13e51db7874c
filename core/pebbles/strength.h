// How much each pixel looks like the border of a pebble.
#pragma once

#include <opencv2/core.hpp>

namespace tessera::pebbles {

// 16 to a level of Lab (8 bits a channel), size of the photo (RGB): colour's gradient at two scales, and how far a
// pixel lies in a dark gap. Whole numbers: the same on every platform.
cv::Mat1w border_strength(const cv::Mat3b& photo);

}  // namespace tessera::pebbles
