// One pebble's equatorial slice, from rays to the edges around a point (section 3.2 of the paper).
#pragma once

#include <optional>
#include <vector>

#include "tessera/pebbles/pebble.h"
#include "tessera/pebbles/rays.h"

namespace tessera::pebbles {

// A vertex of the polygonal curve P.
struct Vertex {
  Point place;             // px of the mask
  bool after_gap = false;  // the curve's way to it from the vertex before is not known
};

// P around a free pixel, clockwise on the screen, without its critical vertices (Eq. 3); empty where less than ten
// are left.
std::vector<Vertex> edges_around(const Mask& mask, cv::Point from);

// P with its gaps filled.
Ring closed(const std::vector<Vertex>& vertices);

struct Slice {
  Pebble shape;      // id and area 0, 360 radii
  cv::Point origin;  // the free pixel whose rays it was made of
};

// The slice around a free pixel, from where its centre comes to rest. None where the edges around are too few or the
// curve does not go around its centre.
std::optional<Slice> find_slice(const Mask& mask, cv::Point from);

}  // namespace tessera::pebbles
