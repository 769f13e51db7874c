// An SVG as the pieces' shapes: a picture of the size that was allowed, with at least one shape.
#include "fuzz.h"
#include "tessera/job/shapes.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tessera;
  constexpr std::uint64_t kMaxPixels = 400'000;  // as slim pictures have: a square one would only take time
  const std::string_view svg = fuzz::text_of(data, size);
  looks_like_svg(svg);
  const auto shapes = read_shapes(svg, kMaxPixels);
  if (!shapes) {
    fuzz::require_message(shapes.error());
  } else {
    const auto pixels = static_cast<std::uint64_t>(shapes->width) * static_cast<std::uint64_t>(shapes->height);
    fuzz::require(pixels > 0 && pixels <= kMaxPixels, "the picture is as large as was allowed");
    fuzz::require(shapes->bytes.size() == 3 * pixels, "a picture has all its pixels");
  }
  return 0;
}
