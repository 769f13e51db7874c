// What of a picture is compared (3.2).
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>

#include "tessera/parquetry/params.h"

namespace tessera::parquetry {

using Histogram = std::array<std::int64_t, 256>;
using Tones = std::array<std::uint8_t, 256>;  // a level for each level

// F_intens: (77 R + 150 G + 29 B) / 256, rounded.
cv::Mat1b intensity_of(const cv::Mat3b& rgb);

// F_edge: the magnitude of Sobel's gradient, a quarter of it, rounded, at most 255; so that a step of as many levels
// is an edge of as many. The picture goes on as it ends.
cv::Mat1b edges_of(const cv::Mat1b& intensity);

// Of the levels where `mask` (of the same size, or empty: everywhere) is not 0.
Histogram histogram_of(const cv::Mat1b& levels, const cv::Mat1b& mask);

// Eq. 2: the target's levels, by `weight` (w_hist) of the way to those of the wood with the same share of pixels
// below. No change where either histogram is empty.
Tones matched_tones(const Histogram& target, const Histogram& wood, double weight);

// How many features a pixel has: 1 to 4.
int feature_channels(const Params& params);

// Eq. 1: CV_8UC(feature_channels), intensity and edges and, where weightColour is not 0, Lab's a and b, as far as
// their weights are not 0. They are scaled by their weights, the largest to the full range of 8 bits: only the
// weights' ratios decide. `tones` are applied to the intensity alone, as in the paper. Whole numbers only: the same
// on every platform.
cv::Mat features_of(const cv::Mat3b& rgb, const Params& params, const Tones* tones = nullptr);

}  // namespace tessera::parquetry
