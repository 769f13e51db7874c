// Pebbles in the paper's way: rays from sample points to the edges around.
#pragma once

#include <opencv2/core.hpp>

#include "tessera/base/run_context.h"
#include "tessera/pebbles/params.h"

namespace tessera::pebbles {

// A number from 1 for each pixel inside of a slice, else 0. `edges`: the mask, not 0 on edges. (3.2)
Result<cv::Mat1i> slices_of(const cv::Mat1b& edges, const RunContext& context);

// The number of the pebble that each pixel belongs to, from 1; 0 is ground. `photo` is RGB, at the size that is
// searched.
Result<cv::Mat1i> segment_by_rays(const cv::Mat3b& photo, const Params& params, const RunContext& context);

}  // namespace tessera::pebbles
