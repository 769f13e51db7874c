// What is known of a pebble once the photo has been read: a place and an outline.
#pragma once

#include <vector>

#include "tessera/geometry/polygon.h"

namespace tessera::pebbles {

struct Pebble {
  int id = 0;    // from 1, in reading order of the centres' rows and columns; its number in the label map
  Point centre;  // source pixels; the outline is star-shaped around it
  std::vector<double> radii;  // source pixels, > 0: r(phi) for phi = 2 pi k / radii.size(), from x towards y
  double area_px = 0;         // of its labelled pixels, source px^2
};

// The outline r(phi) as a ring, a vertex a radius, clockwise on the screen.
Ring outline(const Pebble& pebble);

}  // namespace tessera::pebbles
