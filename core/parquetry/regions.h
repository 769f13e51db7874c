// Label maps whose regions can be sawn: each in one piece, and nowhere too narrow (3.4).
#pragma once

#include <opencv2/core.hpp>

#include "tessera/voronoi/rasterizer.h"

namespace tessera::parquetry {

struct Regions {
  LabelMap labels;  // 0 to count - 1, in the order of their first pixels; each 4-connected
  int count = 0;
};

// The connected parts of equal values.
Regions regions_of(const cv::Mat1i& values);

// Regions whose bounds are longer than `most` px (>= 1) cut in two across these, through the middle of their pixels,
// until none is.
Regions split_large(Regions regions, double most);

// Regions that a disc of diameter `width` px fits into everywhere but in corners, in one piece when that is taken off
// all around:
//
// 1. Those with no room for the disc, and no larger than width^2, go to the neighbour that they have the longest side
//    with, the smallest first.
// 2. Others are cut apart at necks, and tails are cut off; of lines, which are tails only, nothing is left.
// 3. Each pixel that was cut off goes to the region next to it, which may be the one that it was cut from.
//
// Again, until nothing is left to do; what still is after some rounds is joined as in 1. Regions that were wide
// enough stay as they are, but for what they are given.
Regions widened(Regions regions, double width);

// Regions that enclose others cut in two, across the longer side of their bounds and through the middle of the holes,
// until none does.
Regions without_holes(Regions regions);

// The marked regions (one a region) joined with the neighbours that they have the longest side with, the smallest
// first; one that another was joined with in this call stays.
Regions joined(const Regions& regions, const std::vector<char>& marked);

}  // namespace tessera::parquetry
