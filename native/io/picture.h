// Pictures from files, decoded for the core.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "tessera/base/status.h"
#include "tessera/image/image_view.h"

namespace tessera {

// 8 bits a channel, sRGB, R G B interleaved, alpha laid over white, turned as EXIF says.
struct Picture {
  int width = 0;
  int height = 0;
  std::unique_ptr<std::uint8_t[]> rgb;      // width * height * 3 bytes at least
  std::unique_ptr<std::uint8_t[]> alpha{};  // width * height bytes; null: all of it is opaque
  double dpi = 0;                           // pixels an inch that the file tells, the same both ways; 0: it does not

  ImageView view() const { return {rgb.get(), width, height, std::ptrdiff_t{3} * width, alpha.get(), dpi}; }
};

// Decodes a PNG, JPEG, WebP, TIFF or BMP file of 8 or 16 bits a channel; the first page or frame. kInvalidInput where
// it is of another kind, damaged, cut short, empty or of more than `max_pixels`; that is found in the header, before
// memory is taken for the pixels.
Result<Picture> decode_picture(std::span<const std::uint8_t> bytes, std::uint64_t max_pixels);
// The same of a picture whose pixels are numbers rather than colours: those of a PNG of 16-bit grey are kept, as the
// bytes 0, high, low of a pixel.
Result<Picture> decode_numbers(std::span<const std::uint8_t> bytes, std::uint64_t max_pixels);

}  // namespace tessera
