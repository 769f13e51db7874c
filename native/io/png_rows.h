// A PNG file's rows, one after the other, for pictures too large for memory.
#pragma once

#include <memory>
#include <string>

#include "tessera/image/row_source.h"

namespace tessera {

// A file that can be read so: a PNG that is not interlaced and that no EXIF turns, of any size up to 2^20 px a side.
// Pixels are as decode_picture() has them. Null for files of other kinds; errors, with the path as their field, where
// the file cannot be read or is damaged.
Result<std::unique_ptr<RowSource>> open_png_rows(const std::string& path);

}  // namespace tessera
