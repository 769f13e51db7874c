// Where a picture draws the eye.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace tessera {

// How salient each pixel is: how far its colour, softened a little, is from the picture's mean in Lab, squared, in
// levels of lab_of() (0 to 3 * 255^2). Large and small things alike keep their outlines, since no frequency but that
// of noise is left out: R. Achanta, S. Hemami, F. Estrada, S. Suesstrunk, "Frequency-tuned Salient Region Detection",
// CVPR 2009, Eq. 1 and 4. By whole numbers: the same on every platform.
cv::Mat1i saliency_of(const cv::Mat3b& rgb);

}  // namespace tessera
