// Edges of a picture.
#pragma once

#include <opencv2/core.hpp>

namespace tessera {

struct EdgeParams {
  double sigma = 1.5;    // px: what is finer is smoothed away
  double share = 0.15;   // of the picture's pixels: those with the strongest gradients may begin an edge
  double shortest = 10;  // px: shorter edges are left out
};

// CV_8U, 255 on an edge one pixel wide, 0 elsewhere. Canny's detector on the strongest of the three channels'
// gradients; its thresholds are quantiles of the picture's own, since no fixed ones suit every photo. A picture
// without contrast has no edges. All integers: the same on every platform.
cv::Mat1b find_edges(const cv::Mat3b& picture, const EdgeParams& params);

}  // namespace tessera
