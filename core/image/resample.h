// Pictures at other sizes.
#pragma once

#include <opencv2/core.hpp>

#include "tessera/image/image_view.h"

namespace tessera {

// The picture at `width` pixels and a height in proportion (at least one), each pixel the mean of the area it stands
// for; a copy where the picture is no wider. Whole numbers only: the same on every platform.
cv::Mat3b shrunk(const ImageView& picture, int width);

}  // namespace tessera
