// Pieces that seams have made too narrow (3.4: cuts must be fabricable).
#pragma once

#include "tessera/parquetry/seams.h"

namespace tessera::parquetry {

// Places of a piece that are narrower than `width` px: all of it where no disc of that diameter finds room or such
// discs can not go from one place to another, else what the disc does not reach, as far as that is more than a corner
// of 49 degrees leaves. `piece`: 255 inside, with a frame of 0.
std::vector<cv::Rect> narrow_places(const cv::Mat1b& piece, double width);

// Where a seam is in `places`, in those of `rows`, it becomes an eighth less far from its line of the grid than the
// farthest of them is, and beside them as far as keeps it 6-connected: little of a seam is moved where little is
// wrong. Whether it has moved.
bool straighten(Seam& seam, int line, cv::Range rows, cv::Range places);

// Straightens seams until no piece is narrower than `width` px where a seam could do something about it, nor has
// pixels that it may not have. Seams are at most `stray` px off the grid's lines, and stay so.
void widen(const Reconstruction& reconstruction, int stray, double width, Seams& seams);

// Of the pixels along all seams but the borders, the share that differs.
double share_moved(const Seams& before, const Seams& after);

}  // namespace tessera::parquetry
