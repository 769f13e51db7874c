// Where on a scan there is wood.
#pragma once

#include <opencv2/core.hpp>

namespace tessera::parquetry {

// 255 for wood, 0 for the scanner's lid around it and behind its holes; all 255 where no lid is seen. A lid is known
// by two signs that wood never shows together: where it reaches the scan's border its colour is even but for the
// noise of the scan, and that noise is uncorrelated - averaged over a neighbourhood it vanishes, which grain does
// not. Holes are even places of the lid's colour. Crumbs smaller than 5 mm each way are no wood. Whole numbers
// decide.
cv::Mat1b find_wood(const cv::Mat3b& rgb, double mm_per_px);

}  // namespace tessera::parquetry
