// Corrections that a person makes to what was found.
#pragma once

#include <opencv2/core.hpp>
#include <string_view>
#include <vector>

#include "tessera/geometry/point.h"

namespace tessera::pebbles {

struct Edit {
  enum class Kind { kMerge, kSplit, kDelete, kAdd };
  Kind kind;
  std::vector<Point> points;  // source pixels: of the pebbles meant; of kAdd, its outline
};

// Reads "merge 120,44 130,60; split 10,10 18,14; delete 5,8; add 60,60 80,60 70,78": commands apart by ';' or line
// ends, empty ones skipped, those that begin with '#' are remarks. merge and split take two points or more, delete
// one or more, add three or more. False: it is not such a list.
bool parse_edits(std::string_view text, std::vector<Edit>& edits);

// Makes the corrections in order; `scale` is pixels of `labels` a source pixel. Points that hit no pebble do nothing.
// Two pebbles become one with the gap between them; a split goes half way between the points, each pixel to the next
// one. Returns how many edits had an effect.
int apply_edits(const std::vector<Edit>& edits, double scale, cv::Mat1i& labels);

}  // namespace tessera::pebbles
