// JPEG through libjpeg-turbo's own interface, baseline and progressive.
#include <turbojpeg.h>

#include <cstring>
#include <string_view>

#include "tessera/io/byte_order.h"
#include "tessera/io/decoders.h"
#include "tessera/io/exif.h"

namespace tessera {
namespace {

struct Handle {
  tjhandle value = tjInitDecompress();
  Handle() = default;
  ~Handle() { tjDestroy(value); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
};

// JFIF's header (APP0) and EXIF's block (APP1) stand in segments before the picture.
ExifFacts facts_of(Bytes file) {
  constexpr std::string_view kJfif("JFIF\0", 5), kExif("Exif\0\0", 6);
  constexpr std::uint8_t kApp0 = 0xE0, kApp1 = 0xE1, kStartOfScan = 0xDA;
  ExifFacts exif;
  double dpi = 0;
  std::size_t at = 2;
  while (at + 4 <= file.size() && file[at] == 0xFF && file[at + 1] != kStartOfScan) {
    const std::size_t length = read_number(file, at + 2, 2, ByteOrder::kBig);
    if (length < 2 || length > file.size() - at - 2) break;
    const Bytes body = file.subspan(at + 4, length - 2);
    const auto is = [&](std::uint8_t segment, std::string_view mark) {
      return file[at + 1] == segment && body.size() > mark.size() &&
             !std::memcmp(body.data(), mark.data(), mark.size());
    };
    if (is(kApp0, kJfif)) {
      const auto unit = read_number(body, 7, 1, ByteOrder::kBig);  // 0: only the pixels' shape
      const double to_inches = unit == 1 ? 1 : unit == 2 ? 2.54 : 0;
      dpi = same_both_ways(to_inches * read_number(body, 8, 2, ByteOrder::kBig),
                           to_inches * read_number(body, 10, 2, ByteOrder::kBig));
    }
    if (is(kApp1, kExif)) exif = read_exif(body.subspan(kExif.size()));
    at += 2 + length;
  }
  if (dpi > 0) exif.dpi = dpi;
  return exif;
}

// Ink is stored inverted, as Adobe does it; so is the light that is left.
void cmyk_to_rgb(Picture& picture) {
  const auto pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  const std::uint8_t* from = picture.rgb.get();
  std::uint8_t* to = picture.rgb.get();
  for (std::size_t i = 0; i < pixels; ++i, from += 4, to += 3) {
    const int black = from[3];
    for (int c = 0; c < 3; ++c) to[c] = static_cast<std::uint8_t>((from[c] * black + 127) / 255);
  }
}

// Stray bytes between segments are common and harm nothing; any other warning means pixels that were made up.
bool has_stray_bytes_only(tjhandle handle) {
  const std::string_view message = tjGetErrorStr2(handle);
  return tjGetErrorCode(handle) == TJERR_WARNING && message.find("extraneous bytes") != std::string_view::npos;
}

}  // namespace

Result<Decoded> decode_jpeg(Bytes file, std::uint64_t max_pixels) {
  const Handle handle;
  if (!handle.value) return fail(StatusCode::kInternal, "", "the JPEG decoder does not start");
  int width = 0, height = 0, subsampling = 0, colours = 0;
  if (tjDecompressHeader3(handle.value, file.data(), file.size(), &width, &height, &subsampling, &colours) != 0) {
    return damaged("JPEG", tjGetErrorStr2(handle.value));
  }
  if (auto size = check_size(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height), max_pixels);
      !size)
    return tl::unexpected<Status>(std::move(size.error()));

  const bool ink = colours == TJCS_CMYK || colours == TJCS_YCCK;
  const int format = ink ? TJPF_CMYK : TJPF_RGB;
  Decoded decoded{make_picture(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height), ink ? 4 : 3)};
  if (tjDecompress2(handle.value, file.data(), file.size(), decoded.picture.rgb.get(), width, 0, height, format,
                    TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS) != 0 &&
      !has_stray_bytes_only(handle.value)) {
    return damaged("JPEG", tjGetErrorStr2(handle.value));
  }
  if (ink) cmyk_to_rgb(decoded.picture);
  const ExifFacts facts = facts_of(file);
  decoded.orientation = facts.orientation;
  decoded.picture.dpi = facts.dpi;
  return decoded;
}

}  // namespace tessera
