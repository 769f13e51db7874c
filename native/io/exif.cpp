#include "tessera/io/exif.h"

#include <algorithm>

#include "tessera/io/byte_order.h"
#include "tessera/io/decoders.h"

namespace tessera {

ExifFacts read_exif(std::span<const std::uint8_t> exif) {
  constexpr std::size_t kEntryBytes = 12;
  enum : std::uint32_t { kOrientation = 0x0112, kXResolution = 0x011A, kYResolution = 0x011B, kUnit = 0x0128 };
  ExifFacts facts;
  const std::uint32_t mark = read_number(exif, 0, 2, ByteOrder::kBig);
  if (mark != 0x4949 && mark != 0x4D4D) return facts;  // "II", "MM"
  const ByteOrder order = mark == 0x4949 ? ByteOrder::kLittle : ByteOrder::kBig;
  const auto rational = [&](std::size_t at) {
    const double divisor = read_number(exif, at + 4, 4, order);
    return divisor > 0 ? read_number(exif, at, 4, order) / divisor : 0;
  };
  double x = 0, y = 0, to_inches = 1;
  const std::size_t directory = read_number(exif, 4, 4, order);
  const std::size_t entries = read_number(exif, directory, 2, order);
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + i * kEntryBytes;
    const std::uint32_t tag = read_number(exif, entry, 2, order), value = read_number(exif, entry + 8, 2, order);
    if (tag == kOrientation && value >= 1 && value <= 8) facts.orientation = static_cast<int>(value);
    if (tag == kXResolution) x = rational(read_number(exif, entry + 8, 4, order));
    if (tag == kYResolution) y = rational(read_number(exif, entry + 8, 4, order));
    if (tag == kUnit) to_inches = value == 2 ? 1 : value == 3 ? 2.54 : 0;
  }
  facts.dpi = same_both_ways(x * to_inches, y * to_inches);
  return facts;
}

namespace {

// Where the pixels of the upright picture come from: the first one, and the step to its right and lower neighbours.
struct Walk {
  std::ptrdiff_t first, right, down;
};

Walk walk_of(int orientation, std::ptrdiff_t width, std::ptrdiff_t height) {
  const std::ptrdiff_t top_right = width - 1, bottom_left = (height - 1) * width, last = width * height - 1;
  switch (orientation) {
    case 2: return {top_right, -1, width};
    case 3: return {last, -1, -width};
    case 4: return {bottom_left, 1, -width};
    case 5: return {0, width, 1};
    case 6: return {bottom_left, -width, 1};
    case 7: return {last, -width, -1};
    case 8: return {top_right, width, -1};
    default: return {0, 1, width};
  }
}

}  // namespace

Picture turned_upright(Picture picture, int orientation) {
  if (orientation <= 1 || orientation > 8) return picture;
  const bool on_its_side = orientation >= 5;
  const Walk walk = walk_of(orientation, picture.width, picture.height);
  Picture upright = make_picture(static_cast<std::uint64_t>(on_its_side ? picture.height : picture.width),
                                 static_cast<std::uint64_t>(on_its_side ? picture.width : picture.height), 3);
  std::uint8_t* to = upright.rgb.get();
  for (std::ptrdiff_t y = 0; y < upright.height; ++y) {
    for (std::ptrdiff_t x = 0; x < upright.width; ++x, to += 3) {
      const std::uint8_t* from = picture.rgb.get() + 3 * (walk.first + x * walk.right + y * walk.down);
      std::copy(from, from + 3, to);
    }
  }
  upright.dpi = picture.dpi;
  if (!picture.alpha) return upright;
  const auto pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  upright.alpha = std::make_unique_for_overwrite<std::uint8_t[]>(pixels);
  std::uint8_t* opacity = upright.alpha.get();
  for (std::ptrdiff_t y = 0; y < upright.height; ++y)
    for (std::ptrdiff_t x = 0; x < upright.width; ++x)
      *opacity++ = picture.alpha[static_cast<std::size_t>(walk.first + x * walk.right + y * walk.down)];
  return upright;
}

}  // namespace tessera
