// A picture as it enters the core.
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>

namespace tessera {

// Decoded pixels that somebody else owns: 8 bits a channel, sRGB, R G B interleaved, rows of `stride` bytes from the
// top. Alpha has been laid over white, EXIF orientation applied. Valid while the owner keeps `pixels`.
struct ImageView {
  const std::uint8_t* pixels = nullptr;
  int width = 0;
  int height = 0;
  std::ptrdiff_t stride = 0;
  const std::uint8_t* alpha = nullptr;  // opacity, a byte a pixel without gaps; null: all of it is opaque
  double dpi = 0;                       // how many pixels an inch the file tells; 0: nothing

  // The same pixels for OpenCV, read only, not copied.
  cv::Mat3b mat() const {
    return {height, width, reinterpret_cast<cv::Vec3b*>(const_cast<std::uint8_t*>(pixels)),
            static_cast<std::size_t>(stride)};
  }
};

}  // namespace tessera
