// Colours of tiles (paper, 5.1), and of a limited palette.
#pragma once

#include <string>
#include <vector>

#include "tessera/geometry/piece.h"
#include "tessera/image/image_view.h"
#include "tessera/mosaic/params.h"

namespace tessera::mosaic {

// The colour of each ring's tile, before a palette. A ring without a pixel takes the one at its centre.
std::vector<Rgb> tile_colours(const ImageView& photo, const std::vector<Ring>& rings, Sample sample);

// Each colour replaced by the nearest of the palette in Lab; returns the palette, empty where params.palette is.
std::vector<Material> limit_colours(const std::string& palette, std::vector<Rgb>& colours);

}  // namespace tessera::mosaic
