// Files of pictures, as colours and as the numbers of a label picture.
#include "fuzz.h"
#include "tessera/io/picture.h"

namespace tessera::fuzz {
namespace {

void try_picture(const Result<Picture>& picture, std::uint64_t max_pixels) {
  if (!picture) return require_message(picture.error());
  require(picture->width > 0 && picture->height > 0, "a picture has pixels");
  const auto pixels = static_cast<std::size_t>(picture->width) * static_cast<std::size_t>(picture->height);
  require(pixels <= max_pixels, "the picture is as large as was allowed");
  unsigned sum = 0;  // each byte is there
  for (std::size_t i = 0; i < 3 * pixels; ++i) sum += picture->rgb[i];
  for (std::size_t i = 0; picture->alpha && i < pixels; ++i) sum += picture->alpha[i];
  require(sum < 4U * 255U * max_pixels + 1, "bytes are bytes");
}

}  // namespace
}  // namespace tessera::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::uint64_t kMaxPixels = 1 << 16;
  tessera::fuzz::try_picture(tessera::decode_picture({data, size}, kMaxPixels), kMaxPixels);
  tessera::fuzz::try_picture(tessera::decode_numbers({data, size}, kMaxPixels), kMaxPixels);
  return 0;
}
