#include "tessera/io/png_reader.h"

#include <csetjmp>
#include <cstring>

#include "tessera/io/decoders.h"

namespace tessera {
namespace {

void ignore(png_structp, png_const_charp) {}

}  // namespace

void PngReader::keep_message(png_structp png, png_const_charp message) {
  auto* reader = static_cast<PngReader*>(png_get_error_ptr(png));
  std::strncpy(reader->message_, message, sizeof reader->message_ - 1);
  png_longjmp(png, 1);
}

PngReader::PngReader(void* source, png_rw_ptr read)
    : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, this, keep_message, ignore)),
      info_(png_ ? png_create_info_struct(png_) : nullptr) {
  if (info_) png_set_read_fn(png_, source, read);
}

PngReader::~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }

bool PngReader::read_header(bool as_they_are) {
  // NOLINTNEXTLINE(cert-err52-cpp): libpng has no other way to give up
  if (!info_ || setjmp(png_jmpbuf(png_))) return false;
  png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // ours are checked by who reads
  png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_AS_DEFAULT, reinterpret_cast<png_const_bytep>("eXIf\0pHYs"), 2);
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

bool PngReader::read_rows(std::uint8_t* pixels, std::size_t stride, std::size_t rows) {
  // NOLINTNEXTLINE(cert-err52-cpp): libpng has no other way to give up
  if (setjmp(png_jmpbuf(png_))) return false;
  for (int pass = 0; pass < passes_; ++pass) {
    for (std::size_t y = 0; y < rows; ++y) png_read_row(png_, pixels + y * stride, nullptr);
  }
  return true;
}

bool PngReader::read_end() {
  // NOLINTNEXTLINE(cert-err52-cpp): libpng has no other way to give up
  if (setjmp(png_jmpbuf(png_))) return false;
  png_read_end(png_, info_);
  return true;
}

ExifFacts PngReader::exif() {
  png_bytep block = nullptr;
  png_uint_32 size = 0;
  return png_get_eXIf_1(png_, info_, &size, &block) ? read_exif({block, size}) : ExifFacts{};
}

double PngReader::dpi() {
  return dpi_of_metres(png_get_x_pixels_per_meter(png_, info_), png_get_y_pixels_per_meter(png_, info_));
}

}  // namespace tessera
