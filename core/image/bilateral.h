// Smoothing that keeps edges.
#pragma once

#include <opencv2/core.hpp>

namespace tessera {

struct BilateralParams {
  double sigma_px = 2;       // > 0; of the distance between pixels
  double sigma_levels = 25;  // > 0; of the difference of their levels in the guide
};

// Each pixel the mean of those around it, weighted by Gaussians of their distance and of how much they differ in
// `guide`, of the picture's size (joint bilateral filter). With the picture as its own guide that of C. Tomasi and
// R. Manduchi, "Bilateral Filtering for Gray and Color Images", ICCV 1998. The picture goes on as it ends. Weights
// are whole numbers: the same on every platform, for any number of threads.
cv::Mat1b joint_bilateral(const cv::Mat1b& picture, const cv::Mat1b& guide, const BilateralParams& params);

// Rolling guidance filter: structures smaller than sigma_px vanish, edges of larger ones come back round by round
// (Q. Zhang, X. Shen, L. Xu and J. Jia, "Rolling Guidance Filter", ECCV 2014). `rounds` >= 1; the first has a guide
// without edges.
cv::Mat1b rolling_guidance(const cv::Mat1b& picture, const BilateralParams& params, int rounds);

}  // namespace tessera
