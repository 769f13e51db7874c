// A scanned board of veneer, as matching and cutting see it.
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace tessera::parquetry {

// Pixels are square, `mm_per_px` wide, the same for every panel of a job: scans of other resolutions are resampled
// when they are taken in. Coordinates on a panel: pixels or mm, seen from the front, origin at the scan's top left
// corner, y down.
struct Panel {
  std::string name;      // plain word: letters, digits, '-', '_'; unique in a job
  cv::Mat3b scan;        // RGB
  cv::Mat1b mask;        // of the scan's size; 255: wood that may be cut, 0: background, holes, margins
  double mm_per_px = 0;  // > 0

  double width_mm() const { return scan.cols * mm_per_px; }
  double height_mm() const { return scan.rows * mm_per_px; }
};

}  // namespace tessera::parquetry
