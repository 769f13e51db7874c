// A scanned board of veneer, as matching and cutting see it.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "tessera/parquetry/registration.h"

namespace tessera::parquetry {

// Pixels are square, `mm_per_px` wide, the same for every panel of a job: scans of other resolutions are resampled
// when they are taken in. Coordinates on a panel: pixels or mm, seen from the front, origin at the scan's top left
// corner, y down.
struct Panel {
  std::string name;      // plain word: letters, digits, '-', '_'; unique in a job
  cv::Mat3b scan;        // RGB
  cv::Mat1b mask;        // of the scan's size; 255: wood that may be cut, 0: background, holes, margins
  double mm_per_px = 0;  // > 0
  double scan_px = 1;    // pixels of the scan that was handed in to one of these

  // Beside the wood; matching does not look at them.
  std::vector<Point> fiducials{};   // middles of its markers, px
  double fiducial_mm = 0;           // their diameter
  bool registered = false;          // the next two are known
  Affine to_machine{};              // from where the cutter sees the panel, mm (mirrored where that is the back)
  std::vector<double> residuals{};  // mm, of each mark on the machine

  double width_mm() const { return scan.cols * mm_per_px; }
  double height_mm() const { return scan.rows * mm_per_px; }
};

}  // namespace tessera::parquetry
