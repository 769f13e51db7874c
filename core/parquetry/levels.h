// Coarser views of features, to tell from below what a match costs.
//
// For a block of n pixels with means m, m' and standard deviations s, s' of a feature,
//   sum (f - f')^2 >= n ((m - m')^2 + (s - s')^2),
// since the covariance is at most s s'. Sums over blocks that do not overlap bound Eq. 4 from below. Means and
// deviations are kept as bytes; what rounding can change is left off the bounds, so that none is too high.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "tessera/parquetry/rows.h"
#include "tessera/parquetry/shape.h"

namespace tessera::parquetry {

// How a mean or deviation of a channel becomes a byte: (v - offset) * scale, cut off at 0 and 255. Cutting off brings
// nothing further apart, nor does `scale` differ between channels: distances of bytes are those of values, times
// `scale`, or less.
struct ByteCode {
  int channels = 1;
  double scale = 1;
  std::array<double, 4> offset{};  // of the means; deviations have none

  double mean(double v, int channel) const;  // not rounded
  double deviation(double v) const;
  std::uint8_t mean_byte(float v, int channel) const;  // rounded, within a thousandth
  std::uint8_t deviation_byte(float v) const;
};

// For features as they occur where the masks are not 0.
ByteCode byte_code(const std::vector<cv::Mat>& features, const std::vector<cv::Mat1b>& masks);

struct Moments {
  double mean, deviation;
};
// Of a channel of a block of a picture of bytes.
Moments moments_of(const cv::Mat& features, int channel, cv::Rect block);

// Blocks of kGroup px, in rows of kGroup px, one beginning at each column: for each channel a mean and a deviation,
// rounded. Plane i has those that begin i px from the first column of a group. `pixels`: spans of `features`.
Rows fine_level(const Rows& features, const std::vector<Span>& pixels, const std::vector<Span>& groups,
                cv::Size frame, const ByteCode& code);

// For each group of kGroup x kGroup positions of a block with `side` pixels the least and the greatest mean and
// deviation, outwards rounded: planes least, greatest mean of the first channel, least, greatest deviation, and so
// on. Of positions where the block is not all in the frame nothing is known; a group of such ones has 0 and 255.
Rows coarse_level(const Rows& features, const std::vector<Span>& pixels, const std::vector<Span>& groups,
                  cv::Size frame, int side, const ByteCode& code);

}  // namespace tessera::parquetry
