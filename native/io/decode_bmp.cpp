// BMP through stb_image.
#include <stb/stb_image.h>

#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>

#include "tessera/io/byte_order.h"
#include "tessera/io/decoders.h"

namespace tessera {
namespace {

struct Header {
  std::uint64_t width = 0, height = 0, bits = 0, compression = 0, pixels_at = 0;
};

Header header_of(Bytes file) {
  constexpr std::uint32_t kOldHeaderBytes = 12;
  const auto number = [&](std::size_t at, std::size_t size) {
    return read_number(file, at, size, ByteOrder::kLittle);
  };
  if (number(14, 4) == kOldHeaderBytes) return {number(18, 2), number(20, 2), number(24, 2), 0, number(10, 4)};
  // A negative height means rows from the top.
  const auto height = static_cast<std::uint64_t>(std::abs(std::int64_t{static_cast<std::int32_t>(number(22, 4))}));
  return {number(18, 4), height, number(28, 2), number(30, 4), number(10, 4)};
}

double dpi_of(Bytes file) {
  if (read_number(file, 14, 4, ByteOrder::kLittle) < 40) return 0;
  return dpi_of_metres(read_number(file, 38, 4, ByteOrder::kLittle), read_number(file, 42, 4, ByteOrder::kLittle));
}

struct Free {
  void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

}  // namespace

Result<Decoded> decode_bmp(Bytes file, std::uint64_t max_pixels) {
  const Header header = header_of(file);
  if (auto size = check_size(header.width, header.height, max_pixels); !size)
    return tl::unexpected<Status>(std::move(size.error()));
  constexpr std::uint64_t kPlain = 0, kWithMasks = 3;
  if (header.compression != kPlain && header.compression != kWithMasks) {
    return fail(StatusCode::kInvalidInput, "", "is a compressed BMP, expected one without compression");
  }
  const std::uint64_t row_bytes = (header.width * header.bits + 31) / 32 * 4;
  if (header.pixels_at + row_bytes * header.height > file.size()) return damaged("BMP", "cut short");
  if (file.size() > std::numeric_limits<int>::max()) return damaged("BMP", "longer than 2 GiB");

  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, Free> rgba(
      stbi_load_from_memory(file.data(), static_cast<int>(file.size()), &width, &height, &channels, STBI_rgb_alpha));
  if (!rgba) return damaged("BMP", stbi_failure_reason());
  Decoded decoded{make_picture(header.width, header.height, 4)};
  std::memcpy(decoded.picture.rgb.get(), rgba.get(), header.width * header.height * 4);
  lay_over_white(decoded.picture, Alpha::kStraight);
  decoded.picture.dpi = dpi_of(file);
  return decoded;
}

}  // namespace tessera
