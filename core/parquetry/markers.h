// Fiducial markers on a scan.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "tessera/geometry/point.h"

namespace tessera::parquetry {

// A round dark mark, full or a ring, on a light ground.
struct Marker {
  Point at;             // its middle, px, finer than a pixel
  double diameter = 0;  // px
};

// Marks of 1.5 to 20 mm that are round within some percent and all of one size, from the top down; none where there
// are fewer than three such.
std::vector<Marker> find_markers(const cv::Mat3b& rgb, double mm_per_px);

}  // namespace tessera::parquetry
