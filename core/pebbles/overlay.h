// What was found, drawn over the photo.
#pragma once

#include <vector>

#include "tessera/geometry/raster.h"
#include "tessera/image/image_view.h"
#include "tessera/pebbles/pebble.h"

namespace tessera::pebbles {

// The photo, 8-bit RGB, with each outline as a bright line in a dark one.
Raster overlay(const ImageView& photo, const std::vector<Pebble>& pebbles);

}  // namespace tessera::pebbles
