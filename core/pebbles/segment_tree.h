// Pebbles as those regions of a watershed's tree that look most like pebbles.
#pragma once

#include <opencv2/core.hpp>

#include "tessera/base/run_context.h"
#include "tessera/pebbles/params.h"

namespace tessera::pebbles {

// The number of the pebble that each pixel belongs to, from 1; 0 is ground. `photo` is RGB, at the size that is
// searched. Where the paper follows rays to the edges around a point, which breaks pebbles at acute angles, this
// weighs whole regions.
Result<cv::Mat1i> segment_by_tree(const cv::Mat3b& photo, const Params& params, const RunContext& context);

}  // namespace tessera::pebbles
