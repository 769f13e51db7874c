// WebP through libwebp, lossy and lossless.
#include <webp/decode.h>

#include <cstring>

#include "tessera/io/byte_order.h"
#include "tessera/io/decoders.h"
#include "tessera/io/exif.h"

namespace tessera {
namespace {

const char* reason_of(VP8StatusCode status) {
  switch (status) {
    case VP8_STATUS_NOT_ENOUGH_DATA:
    case VP8_STATUS_SUSPENDED: return "cut short";
    case VP8_STATUS_UNSUPPORTED_FEATURE: return "a feature we do not read";
    case VP8_STATUS_OUT_OF_MEMORY: return "out of memory";
    default: return "not a valid stream";
  }
}

// EXIF's block is a chunk of the RIFF file; some writers put JPEG's mark before it.
ExifFacts facts_of(Bytes file) {
  constexpr std::size_t kFirstChunk = 12, kChunkHead = 8, kMarkBytes = 6;
  std::size_t at = kFirstChunk;
  while (at + kChunkHead <= file.size()) {
    const std::size_t length = read_number(file, at + 4, 4, ByteOrder::kLittle);
    if (length > file.size() - at - kChunkHead) break;
    if (!std::memcmp(&file[at], "EXIF", 4)) {
      const Bytes body = file.subspan(at + kChunkHead, length);
      const bool marked = length > kMarkBytes && !std::memcmp(body.data(), "Exif", 4);
      return read_exif(marked ? body.subspan(kMarkBytes) : body);
    }
    at += kChunkHead + length + length % 2;
  }
  return {};
}

}  // namespace

Result<Decoded> decode_webp(Bytes file, std::uint64_t max_pixels) {
  WebPDecoderConfig config;
  if (!WebPInitDecoderConfig(&config)) return fail(StatusCode::kInternal, "", "the WebP decoder does not start");
  if (const auto status = WebPGetFeatures(file.data(), file.size(), &config.input); status != VP8_STATUS_OK) {
    return damaged("WebP", reason_of(status));
  }
  if (config.input.has_animation) {
    return fail(StatusCode::kInvalidInput, "", "is an animated WebP, expected a still picture");
  }
  const auto width = static_cast<std::uint64_t>(config.input.width);
  const auto height = static_cast<std::uint64_t>(config.input.height);
  if (auto size = check_size(width, height, max_pixels); !size)
    return tl::unexpected<Status>(std::move(size.error()));

  const int channels = config.input.has_alpha ? 4 : 3;
  Decoded decoded{make_picture(width, height, channels)};
  config.output.colorspace = config.input.has_alpha ? MODE_RGBA : MODE_RGB;
  config.output.is_external_memory = 1;
  config.output.u.RGBA.rgba = decoded.picture.rgb.get();
  config.output.u.RGBA.stride = channels * config.input.width;
  config.output.u.RGBA.size = width * height * static_cast<std::size_t>(channels);
  if (const auto status = WebPDecode(file.data(), file.size(), &config); status != VP8_STATUS_OK) {
    return damaged("WebP", reason_of(status));
  }
  if (config.input.has_alpha) lay_over_white(decoded.picture, Alpha::kStraight);
  const ExifFacts facts = facts_of(file);
  decoded.orientation = facts.orientation;
  decoded.picture.dpi = facts.dpi;
  return decoded;
}

}  // namespace tessera
