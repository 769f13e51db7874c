// TIFF through libtiff: grey, palette, RGB, CMYK, YCbCr of up to 16 bits; the first page.
#define TIFF_DISABLE_DEPRECATED  // its integer names are OpenCV's too
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstring>

#include "tessera/io/decoders.h"

namespace tessera {
namespace {

// A file in memory, with a position.
struct Memory {
  Bytes bytes;
  std::uint64_t at = 0;
};

tmsize_t read_memory(thandle_t handle, void* out, tmsize_t size) {
  auto* memory = static_cast<Memory*>(handle);
  const std::uint64_t left = memory->bytes.size() - std::min<std::uint64_t>(memory->at, memory->bytes.size());
  const auto taken = static_cast<std::size_t>(std::min<std::uint64_t>(left, static_cast<std::uint64_t>(size)));
  if (taken > 0) std::memcpy(out, memory->bytes.data() + memory->at, taken);
  memory->at += taken;
  return static_cast<tmsize_t>(taken);
}

tmsize_t write_nothing(thandle_t, void*, tmsize_t) { return 0; }

toff_t seek_memory(thandle_t handle, toff_t offset, int whence) {
  auto* memory = static_cast<Memory*>(handle);
  const std::uint64_t from = whence == SEEK_CUR ? memory->at : whence == SEEK_END ? memory->bytes.size() : 0;
  return memory->at = from + offset;
}

int close_nothing(thandle_t) { return 0; }

toff_t size_of_memory(thandle_t handle) { return static_cast<Memory*>(handle)->bytes.size(); }

int map_memory(thandle_t handle, void** base, toff_t* size) {
  const Bytes bytes = static_cast<Memory*>(handle)->bytes;
  *base = const_cast<std::uint8_t*>(bytes.data());
  *size = bytes.size();
  return 1;
}

void unmap_nothing(thandle_t, void*, toff_t) {}

// Keeps the first complaint from standard error, and lets no damaged directory ask for absurd buffers.
int keep_message(TIFF*, void* user_data, const char*, const char* format, va_list arguments) {
  auto* message = static_cast<std::array<char, 160>*>(user_data);
  if (!message->front()) std::vsnprintf(message->data(), message->size(), format, arguments);
  return 1;
}

int keep_quiet(TIFF*, void*, const char*, const char*, va_list) { return 1; }

struct Close {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
  void operator()(TIFFOpenOptions* options) const { TIFFOpenOptionsFree(options); }
};

std::unique_ptr<TIFF, Close> open(Memory& memory, std::array<char, 160>& message) {
  constexpr tmsize_t kLargestBuffer = tmsize_t{1} << 31;
  const std::unique_ptr<TIFFOpenOptions, Close> options(TIFFOpenOptionsAlloc());
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), kLargestBuffer);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_message, &message);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), keep_quiet, nullptr);
  return std::unique_ptr<TIFF, Close>(TIFFClientOpenExt("input", "rm", &memory, read_memory, write_nothing,
                                                        seek_memory, close_nothing, size_of_memory, map_memory,
                                                        unmap_nothing, options.get()));
}

double dpi_of(TIFF* tiff) {
  std::uint16_t unit = RESUNIT_INCH;
  float x = 0, y = 0;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_RESOLUTIONUNIT, &unit);
  TIFFGetField(tiff, TIFFTAG_XRESOLUTION, &x);
  TIFFGetField(tiff, TIFFTAG_YRESOLUTION, &y);
  const double to_inches = unit == RESUNIT_INCH ? 1 : unit == RESUNIT_CENTIMETER ? 2.54 : 0;
  return same_both_ways(to_inches * x, to_inches * y);
}

}  // namespace

Result<Decoded> decode_tiff(Bytes file, std::uint64_t max_pixels) {
  Memory memory{file};
  std::array<char, 160> message{};
  const auto tiff = open(memory, message);
  if (!tiff) return damaged("TIFF", message.data());
  std::uint32_t width = 0, height = 0;
  TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &height);
  if (auto size = check_size(width, height, max_pixels); !size)
    return tl::unexpected<Status>(std::move(size.error()));

  char reason[1024] = "";
  TIFFRGBAImage image;
  if (!TIFFRGBAImageOK(tiff.get(), reason) || !TIFFRGBAImageBegin(&image, tiff.get(), 1, reason)) {
    return fail(StatusCode::kInvalidInput, "", std::string("is a TIFF we cannot read: ") + reason);
  }
  Decoded decoded{make_picture(width, height, 4), image.orientation};
  image.req_orientation = image.orientation;  // rows as they are stored
  const int complete =
      TIFFRGBAImageGet(&image, reinterpret_cast<std::uint32_t*>(decoded.picture.rgb.get()), width, height);
  TIFFRGBAImageEnd(&image);
  if (!complete) return damaged("TIFF", message.data());
  lay_over_white(decoded.picture, Alpha::kPremultiplied);
  decoded.picture.dpi = dpi_of(tiff.get());
  return decoded;
}

}  // namespace tessera
