// A place of the target picture that one piece of wood fills, and where that piece is cut.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "tessera/geometry/polygon.h"

namespace tessera::parquetry {

// In pixels of the target at the panels' resolution (`Panel::mm_per_px`), y down. Outlines of neighbours share their
// sides to the last bit, and together they are the target.
struct Patch {
  int row = 0, column = 0;  // of the grid, counted from 0; quarters of an adaptive patch have those of their parent
  int part = 0;             // of a cell of the grid that is cut into triangles: 0 or 1
  int level = 0;            // how often it was quartered
  int target = 0;           // which target picture, where several are made from the same panels
  Polygon outline;          // clockwise on the screen
  cv::Rect box;             // the pixels that the outline touches
  cv::Mat1b mask;           // of the box's size; 255: a pixel that is matched, its middle inside
};

// A panel is turned clockwise by `rotation` / rotations of a full turn, and becomes a frame (frames.h); `at` is where
// the top left pixel of the patch's box lies in it.
struct Placement {
  int patch = -1;  // index in the list of patches
  int panel = -1;  // index in the list of panels; -1: no wood was left
  int rotation = 0;
  cv::Point at;
  std::int64_t cost = 0;  // Eq. 4, of 8-bit features
  double turn_deg = 0;    // clockwise from the panel to the assembled piece, [0, 360)
  Point from, to;  // the middle of the patch's box on the target, and where that comes from on the panel, pixels
};

// The outline of a piece, where it is cut from the panel, in the panel's pixels, without kerf.
Polygon on_panel(const Placement& placement, const Polygon& outline);

}  // namespace tessera::parquetry
