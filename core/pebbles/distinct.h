// What is a pebble, and what only a patch of sand or shadow.
#pragma once

#include <opencv2/core.hpp>

#include "tessera/pebbles/params.h"

namespace tessera::pebbles {

// Takes out the labels of regions too small, those sooner that the picture's border cuts, or too hollow, darker ones
// sooner, or that stand out too little: whose mean colour differs from that of what lies around by less than
// params.contrast times the grain of their own surface.
void drop_indistinct(const cv::Mat3b& lab, const Params& params, cv::Mat1i& labels);

}  // namespace tessera::pebbles
