#include "tessera/io/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "tessera/base/colour.h"
#include "tessera/io/decoders.h"
#include "tessera/io/exif.h"

namespace tessera {
namespace {

// OpenCV counts pixels and bytes of a row in int.
constexpr std::uint64_t kMaxSide = 1 << 20;
constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 30;

using Decoder = Result<Decoded> (*)(Bytes, std::uint64_t);

// By the first bytes, whatever the file is called; null: none of ours.
Decoder decoder_for(Bytes file) {
  const std::string_view head(reinterpret_cast<const char*>(file.data()), std::min<std::size_t>(file.size(), 16));
  const auto has = [&](std::string_view mark, std::size_t at = 0) {
    return head.size() >= at + mark.size() && head.substr(at, mark.size()) == mark;
  };
  if (has("\x89PNG\r\n\x1A\n")) return decode_png;
  if (has("\xFF\xD8\xFF")) return decode_jpeg;
  if (has("RIFF") && has("WEBP", 8)) return decode_webp;
  if (has({"II*\0", 4}) || has({"MM\0*", 4}) || has({"II+\0", 4}) || has({"MM\0+", 4})) return decode_tiff;
  if (has("BM")) return decode_bmp;
  return nullptr;
}

double in_mpx(double pixels) { return pixels / 1e6; }

}  // namespace

Result<void> check_size(std::uint64_t width, std::uint64_t height, std::uint64_t max_pixels) {
  constexpr auto kCode = StatusCode::kInvalidInput;
  if (width == 0 || height == 0) {
    return fail(kCode, "", fmt::format("is {} x {} px, expected at least one pixel", width, height));
  }
  const double pixels = static_cast<double>(width) * static_cast<double>(height);
  if (pixels > static_cast<double>(max_pixels)) {
    return fail(kCode, "",
                fmt::format("is {} x {} px ({:.6g} Mpx), expected at most {:.6g} Mpx (--max-pixels)", width, height,
                            in_mpx(pixels), in_mpx(static_cast<double>(max_pixels))));
  }
  if (width > kMaxSide || height > kMaxSide || pixels > static_cast<double>(kMaxPixels)) {
    return fail(kCode, "",
                fmt::format("is {} x {} px, expected sides of at most {} px and at most {:.6g} Mpx", width, height,
                            kMaxSide, in_mpx(static_cast<double>(kMaxPixels))));
  }
  return {};
}

tl::unexpected<Status> damaged(std::string_view kind, std::string_view reason) {
  std::string line(reason);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c < ' ' || c > '~'; }, ' ');
  return fail(StatusCode::kInvalidInput, "", fmt::format("is a damaged {} ({}), expected a whole one", kind, line));
}

Picture make_picture(std::uint64_t width, std::uint64_t height, int channels) {
  const std::size_t bytes = static_cast<std::size_t>(width * height) * static_cast<std::size_t>(channels);
  return {static_cast<int>(width), static_cast<int>(height), std::make_unique_for_overwrite<std::uint8_t[]>(bytes)};
}

double same_both_ways(double x_dpi, double y_dpi) {
  constexpr double kMost = 1e5, kApart = 0.01;
  const bool usable = x_dpi > 0 && y_dpi > 0 && x_dpi < kMost && std::abs(x_dpi / y_dpi - 1) < kApart;
  return usable ? x_dpi : 0;
}

double dpi_of_metres(double x, double y) {
  constexpr double kInch = 0.0254;
  const double dpi = same_both_ways(kInch * x, kInch * y);
  return std::abs(dpi - std::round(dpi)) <= kInch / 2 ? std::round(dpi) : dpi;
}

void lay_over_white(Picture& picture, Alpha alpha) {
  const auto pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  const auto is_clear = [&](std::size_t i) { return picture.rgb[4 * i + 3] != 255; };
  std::size_t first = 0;
  while (first < pixels && !is_clear(first)) ++first;
  if (first < pixels) {
    picture.alpha = std::make_unique_for_overwrite<std::uint8_t[]>(pixels);
    for (std::size_t i = 0; i < pixels; ++i) picture.alpha[i] = picture.rgb[4 * i + 3];
  }
  const std::uint8_t* from = picture.rgb.get();
  std::uint8_t* to = picture.rgb.get();
  for (std::size_t i = 0; i < pixels; ++i, from += 4, to += 3) {
    const int opacity = from[3];
    for (int c = 0; c < 3; ++c) {
      to[c] = alpha == Alpha::kStraight ? over_white(from[c], opacity)
                                        : static_cast<std::uint8_t>(std::min(255, from[c] + 255 - opacity));
    }
  }
}

Result<Picture> decode_picture(std::span<const std::uint8_t> bytes, std::uint64_t max_pixels) {
  if (bytes.empty()) {
    return fail(StatusCode::kInvalidInput, "", "is empty, expected PNG, JPEG, WebP, TIFF or BMP");
  }
  const Decoder decode = decoder_for(bytes);
  if (!decode) {
    return fail(StatusCode::kInvalidInput, "",
                "is not a picture of a kind we read: expected PNG, JPEG, WebP, TIFF or BMP");
  }
  auto decoded = decode(bytes, max_pixels);
  if (!decoded) return tl::unexpected<Status>(std::move(decoded.error()));
  return turned_upright(std::move(decoded->picture), decoded->orientation);
}

Result<Picture> decode_numbers(std::span<const std::uint8_t> bytes, std::uint64_t max_pixels) {
  if (!is_16_bit_grey_png(bytes)) return decode_picture(bytes, max_pixels);
  auto decoded = decode_png_numbers(bytes, max_pixels);
  if (!decoded) return tl::unexpected<Status>(std::move(decoded.error()));
  return turned_upright(std::move(decoded->picture), decoded->orientation);
}

}  // namespace tessera
