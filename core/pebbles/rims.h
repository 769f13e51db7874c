// The dark gap around a pebble.
#pragma once

#include <opencv2/core.hpp>

namespace tessera::pebbles {

// A watershed's regions meet in the middle of the gap between two pebbles. Takes from each label, inwards from its
// border, what is nearer to the gap's darkness than to the pebble's lightness, and then all but its largest part.
void trim_rims(const cv::Mat3b& lab, cv::Mat1i& labels);

}  // namespace tessera::pebbles
