// Which way up a picture is and how large, as cameras and scanners write it.
#pragma once

#include <cstdint>
#include <span>

#include "tessera/io/picture.h"

namespace tessera {

struct ExifFacts {
  int orientation = 1;  // 1 to 8
  double dpi = 0;       // 0: none told
};

// What a block of EXIF data (a TIFF header and its first directory) tells.
ExifFacts read_exif(std::span<const std::uint8_t> exif);

// The picture as it is meant to be seen.
Picture turned_upright(Picture picture, int orientation);

}  // namespace tessera
