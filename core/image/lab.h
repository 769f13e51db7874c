// CIELAB, where differences are about as large as they look.
#pragma once

#include <opencv2/core.hpp>

namespace tessera {

// sRGB to L (0..255 for 0..100), a + 128, b + 128; D65. By tables and whole numbers: the same on every platform,
// within a level of the exact value.
cv::Mat3b lab_of(const cv::Mat3b& rgb);

}  // namespace tessera
