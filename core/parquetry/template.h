// A patch as it is looked for.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "tessera/parquetry/levels.h"
#include "tessera/parquetry/match_kernel.h"
#include "tessera/parquetry/shape.h"

namespace tessera::parquetry {

// Blocks of coarse levels have one of these sides; the largest of which a patch holds some is used for it.
inline constexpr std::array<int, 3> kCoarseSides = {16, 8, 4};
int coarse_side(const cv::Mat1b& mask);

// Blocks of `side` px, all inside the mask, that do not overlap, their corners at multiples of kGroup from row
// `first` (0 <= first < kGroup) on.
std::vector<cv::Point> blocks_inside(const cv::Mat1b& mask, int side, int first);

struct Template {
  Shape shape;
  Stencil pixels;  // of the mask

  int side = 0;                       // of the coarse blocks
  std::vector<cv::Point> blocks;      // in groups
  std::vector<std::uint8_t> moments;  // for each block and statistic the least and greatest byte

  // For each offset of a position from the first row of its group: the fine blocks that then are inside, from that
  // row on, and the rows above and below them. `lost`: the most that rounding can bring the blocks' bytes nearer, a
  // Euclidean distance.
  struct Fine {
    Stencil blocks, strips;
    double lost = 0;
  };
  std::array<Fine, kGroup> fine;
};

// `features`: of the target.
Template make_template(const Patch& patch, const cv::Mat& features, const ByteCode& code, double half_kerf);

}  // namespace tessera::parquetry
