// Regions of tile sizes: a picture whose colours stand for sizes (paper, 5.2 and Fig. 10).
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "tessera/base/colour.h"

namespace tessera::mosaic {

struct RegionSize {
  Rgb colour;
  double size = 1;
};

// "#0000ff=1.6 #00ff00=1": a colour and a size each, commas or blanks between. Returns false where the text is not of
// that form or a size is not within 0.05 to 20.
bool parse_region_sizes(const std::string& text, std::vector<RegionSize>& sizes);

// The size at each node, `step` pixels apart, that of the colour next to the pixel's.
cv::Mat1f region_sizes(const cv::Mat3b& regions, const std::string& text, cv::Size nodes, double step);

}  // namespace tessera::mosaic
