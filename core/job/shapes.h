// Closed shapes of an SVG, as a picture of numbers.
#pragma once

#include <cstdint>
#include <string_view>

#include "tessera/base/status.h"
#include "tessera/geometry/raster.h"

namespace tessera {

inline constexpr int kShapesSide = 3000;  // px, the longer side of the picture

bool looks_like_svg(std::string_view bytes);

// Each path, polygon, rect, circle and ellipse painted with a number of its own, 1, 2, ..., three bytes a pixel, the
// highest first; what none covers is 0. Later ones lie above earlier ones; what is inside goes by the even-odd rule.
// Transforms are applied; what is in defs, symbols, masks and the like, or not displayed, is left out.
//
// kInvalidInput for what is no well-formed SVG with a viewBox or a width and height, a path that is open or cannot be
// read, one without any shape, and for more than `max_pixels`.
Result<Raster> read_shapes(std::string_view svg, std::uint64_t max_pixels);

}  // namespace tessera
