// PNG through libpng, which checks every chunk's CRC, the stream's end and IEND.
#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <vector>

#include "tessera/io/byte_order.h"
#include "tessera/io/decoders.h"
#include "tessera/io/exif.h"

namespace tessera {
namespace {

struct Source {
  Bytes rest;
  char message[96] = "";
};

void read_bytes(png_structp png, png_bytep out, std::size_t size) {
  auto* source = static_cast<Source*>(png_get_io_ptr(png));
  if (size > source->rest.size()) png_error(png, "cut short");
  std::memcpy(out, source->rest.data(), size);
  source->rest = source->rest.subspan(size);
}

[[noreturn]] void keep_message(png_structp png, png_const_charp message) {
  auto* source = static_cast<Source*>(png_get_error_ptr(png));
  std::strncpy(source->message, message, sizeof source->message - 1);
  png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

// libpng's two structs, and a stack frame that it may jump back to: no destructor may be jumped over, so nothing that
// has one lives in the functions below that call setjmp.
class Reader {
 public:
  explicit Reader(Source& source)
      : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, keep_message, ignore)),
        info_(png_ ? png_create_info_struct(png_) : nullptr) {
    if (info_) png_set_read_fn(png_, &source, read_bytes);
  }
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  // Everything up to the pixels; sets how they are to come: as 8-bit RGB or RGBA, or as they are.
  bool read_header(bool as_they_are) {
    // NOLINTNEXTLINE(cert-err52-cpp): libpng has no other way to give up
    if (!info_ || setjmp(png_jmpbuf(png_))) return false;
    png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // ours have been checked
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_AS_DEFAULT, reinterpret_cast<png_const_bytep>("eXIf\0pHYs"),
                                2);
    png_read_info(png_, info_);
    if (!as_they_are) {
      png_set_expand(png_);
      png_set_scale_16(png_);
      png_set_gray_to_rgb(png_);
    }
    passes_ = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }

  int channels() const { return png_get_channels(png_, info_); }

  // The pixels into `rows`, then what is left of the file.
  bool read_rows(std::uint8_t* pixels, std::size_t stride, std::size_t height) {
    // NOLINTNEXTLINE(cert-err52-cpp): libpng has no other way to give up
    if (setjmp(png_jmpbuf(png_))) return false;
    for (int pass = 0; pass < passes_; ++pass) {
      for (std::size_t y = 0; y < height; ++y) png_read_row(png_, pixels + y * stride, nullptr);
    }
    png_read_end(png_, info_);
    return true;
  }

  ExifFacts exif() {
    png_bytep block = nullptr;
    png_uint_32 size = 0;
    return png_get_eXIf_1(png_, info_, &size, &block) ? read_exif({block, size}) : ExifFacts{};
  }

  double dpi() {
    return dpi_of_metres(png_get_x_pixels_per_meter(png_, info_), png_get_y_pixels_per_meter(png_, info_));
  }

 private:
  png_structp png_;
  png_infop info_;
  int passes_ = 1;
};

constexpr std::size_t kSignatureAndHeader = 8 + 8 + 13 + 4;

bool has_header(Bytes file) { return file.size() >= kSignatureAndHeader && std::memcmp(&file[12], "IHDR", 4) == 0; }

// `stored_bytes` a pixel as the file has them, 0: as colours.
Result<Decoded> decode(Bytes file, std::uint64_t max_pixels, int stored_bytes) {
  if (!has_header(file)) return damaged("PNG", "no header");
  const std::uint32_t width = read_number(file, 16, 4, ByteOrder::kBig);
  const std::uint32_t height = read_number(file, 20, 4, ByteOrder::kBig);
  if (auto size = check_size(width, height, max_pixels); !size)
    return tl::unexpected<Status>(std::move(size.error()));

  Source source{file};
  Reader reader(source);
  if (!reader.read_header(stored_bytes != 0)) return damaged("PNG", source.message);
  const int bytes = stored_bytes != 0 ? stored_bytes : reader.channels();
  Decoded decoded{make_picture(width, height, std::max(3, bytes))};
  const std::size_t stride = std::size_t{width} * static_cast<std::size_t>(bytes);
  if (!reader.read_rows(decoded.picture.rgb.get(), stride, height)) return damaged("PNG", source.message);
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
