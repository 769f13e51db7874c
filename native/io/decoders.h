// One decoder a kind of file, and what they share.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "tessera/base/status.h"
#include "tessera/io/picture.h"

namespace tessera {

using Bytes = std::span<const std::uint8_t>;

// A picture as it is stored, and EXIF's orientation: 1 to 8, 1 is upright.
struct Decoded {
  Picture picture;
  int orientation = 1;
};

Result<Decoded> decode_png(Bytes file, std::uint64_t max_pixels);
// Only PNGs of 16-bit grey; see decode_numbers.
bool is_16_bit_grey_png(Bytes file);
Result<Decoded> decode_png_numbers(Bytes file, std::uint64_t max_pixels);
Result<Decoded> decode_jpeg(Bytes file, std::uint64_t max_pixels);
Result<Decoded> decode_webp(Bytes file, std::uint64_t max_pixels);
Result<Decoded> decode_tiff(Bytes file, std::uint64_t max_pixels);
Result<Decoded> decode_bmp(Bytes file, std::uint64_t max_pixels);

// kInvalidInput for no pixels and for too many.
Result<void> check_size(std::uint64_t width, std::uint64_t height, std::uint64_t max_pixels);
// "is a damaged PNG (IDAT: CRC error)". Libraries put bytes of the file into a reason: what is not ASCII becomes
// spaces.
tl::unexpected<Status> damaged(std::string_view kind, std::string_view reason);

// An uninitialised picture of a size that passed check_size, with `channels` bytes a pixel.
Picture make_picture(std::uint64_t width, std::uint64_t height, int channels);
// A resolution where both are one within a hundredth and can be; else 0.
double same_both_ways(double x_dpi, double y_dpi);
// The same of whole pixels a metre, by which a whole number of dpi can only be told roughly.
double dpi_of_metres(double x, double y);
enum class Alpha { kStraight, kPremultiplied };
// Lays the RGBA pixels in `picture` over white and closes the gaps: RGB remains, and alpha where it is not 255.
void lay_over_white(Picture& picture, Alpha alpha);

}  // namespace tessera
