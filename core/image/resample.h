// Pictures at other sizes.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "tessera/image/image_view.h"

namespace tessera {

// The picture at `width` pixels and a height in proportion (at least one), each pixel the mean of the area it stands
// for; a copy where the picture is no wider. Whole numbers only: the same on every platform.
cv::Mat3b shrunk(const ImageView& picture, int width);

// The picture with pixels of another size: each the mean of `across` by `down` source pixels from the top left corner
// on, `size` of them; beyond its right and lower side the picture goes on as it ends. Whole numbers only.
struct Ratio {
  std::int64_t over, under;  // > 0, products with a picture's side stay below 2^50
};
cv::Mat3b resampled(const ImageView& picture, Ratio across, Ratio down, cv::Size size);

}  // namespace tessera
