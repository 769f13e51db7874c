// A patch as it is looked for.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "tessera/parquetry/levels.h"
#include "tessera/parquetry/match_kernel.h"
#include "tessera/parquetry/shape.h"

namespace tessera::parquetry {

// A square of a patch.
struct Block {
  cv::Point at;  // in groups
  int side;      // pixels: 16, 8 or 4

  cv::Rect box() const { return {kGroup * at, cv::Size(side, side)}; }
};

// The blocks that a patch is looked for by first, from above: all inside the mask, none over another.
std::vector<Block> coarse_blocks(const cv::Mat1b& mask);

struct Template {
  Shape shape;
  Stencil pixels;  // of the mask, the lowest row first

  struct Coarse {
    std::vector<Block> blocks;          // coarse_blocks()
    std::vector<std::uint8_t> moments;  // for each block and statistic the least and greatest byte
    std::vector<int> bands;             // how many blocks end at a band of them and above, for each
    std::vector<int> bottoms;           // the row of pixels below each band
  };
  Coarse coarse;

  // For each offset of a position from the first row of its group: the fine blocks that then are inside, the lowest
  // row first, and the rows of pixels below and above them; and for each look at the blocks (kLook):
  struct Fine {
    Stencil blocks, strips;
    std::vector<double> lost;       // the most that rounding can bring their bytes nearer, a Euclidean distance
    std::vector<double> lost_rest;  // that of the blocks that have not been compared then; before the first look, too
    std::vector<int> bands_above;   // the coarse bands that do not share pixels with those that have
    std::vector<int> looks;  // for each look at `pixels`: looks at fine blocks until all left ones are above them
  };
  std::array<Fine, kGroup> fine;
};

// `features`: of the target.
Template make_template(const Patch& patch, const cv::Mat& features, const ByteCode& code, double half_kerf);

}  // namespace tessera::parquetry
