// PNG through libpng, which checks every chunk's CRC, the stream's end and IEND.
#include <algorithm>
#include <cstring>

#include "tessera/io/byte_order.h"
#include "tessera/io/decoders.h"
#include "tessera/io/png_reader.h"

namespace tessera {
namespace {

void read_bytes(png_structp png, png_bytep out, std::size_t size) {
  auto* rest = static_cast<Bytes*>(png_get_io_ptr(png));
  if (size > rest->size()) png_error(png, "cut short");
  std::memcpy(out, rest->data(), size);
  *rest = rest->subspan(size);
}

constexpr std::size_t kSignatureAndHeader = 8 + 8 + 13 + 4;

bool has_header(Bytes file) { return file.size() >= kSignatureAndHeader && std::memcmp(&file[12], "IHDR", 4) == 0; }

// `stored_bytes` a pixel as the file has them, 0: as colours.
Result<Decoded> decode(Bytes file, std::uint64_t max_pixels, int stored_bytes) {
  if (!has_header(file)) return damaged("PNG", "no header");
  const std::uint32_t width = read_number(file, 16, 4, ByteOrder::kBig);
  const std::uint32_t height = read_number(file, 20, 4, ByteOrder::kBig);
  if (auto size = check_size(width, height, max_pixels); !size)
    return tl::unexpected<Status>(std::move(size.error()));

  Bytes rest = file;
  PngReader reader(&rest, read_bytes);
  if (!reader.read_header(stored_bytes != 0)) return damaged("PNG", reader.message());
  const int bytes = stored_bytes != 0 ? stored_bytes : reader.channels();
  Decoded decoded{make_picture(width, height, std::max(3, bytes))};
  const std::size_t stride = std::size_t{width} * static_cast<std::size_t>(bytes);
  if (!reader.read_rows(decoded.picture.rgb.get(), stride, height) || !reader.read_end())
    return damaged("PNG", reader.message());
  if (bytes == 4) lay_over_white(decoded.picture, Alpha::kStraight);
  const ExifFacts exif = reader.exif();
  decoded.orientation = exif.orientation;
  decoded.picture.dpi = reader.dpi() > 0 ? reader.dpi() : exif.dpi;
  return decoded;
}

}  // namespace

Result<Decoded> decode_png(Bytes file, std::uint64_t max_pixels) { return decode(file, max_pixels, 0); }

bool is_16_bit_grey_png(Bytes file) {
  constexpr std::size_t kDepth = 24, kColourType = 25;
  return has_header(file) && file[1] == 'P' && file[kDepth] == 16 && file[kColourType] == PNG_COLOR_TYPE_GRAY;
}

Result<Decoded> decode_png_numbers(Bytes file, std::uint64_t max_pixels) {
  auto decoded = decode(file, max_pixels, 2);
  if (!decoded) return decoded;
  // Two bytes a pixel become three, from the last one on.
  std::uint8_t* const bytes = decoded->picture.rgb.get();
  for (std::size_t i = static_cast<std::size_t>(decoded->picture.width) * decoded->picture.height; i-- > 0;) {
    const std::uint8_t high = bytes[2 * i], low = bytes[2 * i + 1];
    bytes[3 * i] = 0, bytes[3 * i + 1] = high, bytes[3 * i + 2] = low;
  }
  return decoded;
}

}  // namespace tessera
