// Which way up a picture is, as cameras write it.
#pragma once

#include <cstdint>
#include <span>

#include "tessera/io/picture.h"

namespace tessera {

// The orientation in a block of EXIF data (a TIFF header and its first directory): 1 to 8; 1 where there is none.
int exif_orientation(std::span<const std::uint8_t> exif);

// The picture as it is meant to be seen.
Picture turned_upright(Picture picture, int orientation);

}  // namespace tessera
