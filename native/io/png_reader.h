// libpng's two structs, and a stack frame that it may jump back to: no destructor may be jumped over, so nothing that
// has one lives in the functions below that call setjmp.
#pragma once

#include <png.h>

#include <cstddef>
#include <cstdint>

#include "tessera/io/exif.h"

namespace tessera {

class PngReader {
 public:
  // `read` fills memory from `source` or calls png_error().
  PngReader(void* source, png_rw_ptr read);
  ~PngReader();
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  // Everything up to the pixels; sets how they are to come: as 8-bit RGB or RGBA, or as they are. False as of all
  // below: message() says why.
  bool read_header(bool as_they_are);
  // After the header.
  std::uint32_t width() const { return png_get_image_width(png_, info_); }
  std::uint32_t height() const { return png_get_image_height(png_, info_); }
  int channels() const { return png_get_channels(png_, info_); }
  bool is_interlaced() const { return passes_ > 1; }

  // The next rows; of an interlaced picture all of them.
  bool read_rows(std::uint8_t* pixels, std::size_t stride, std::size_t rows);
  // What comes after the pixels.
  bool read_end();
  ExifFacts exif();
  double dpi();

  const char* message() const { return message_; }

 private:
  [[noreturn]] static void keep_message(png_structp png, png_const_charp message);

  char message_[96] = "";
  png_structp png_;
  png_infop info_;
  int passes_ = 1;
};

}  // namespace tessera
