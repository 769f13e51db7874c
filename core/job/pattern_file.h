// Cells or points from a file: what `tessera measure` reads besides pictures.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tessera/base/status.h"
#include "tessera/geometry/polygon.h"
#include "tessera/points/window.h"

namespace tessera {

struct PatternFile {
  Window window;              // of no area where the file names none
  std::vector<Ring> cells;    // outer rings, clockwise on the screen
  std::vector<Point> points;  // either these or cells
  std::string job_json;       // of an SVG that carries one
};

// A GeoJSON FeatureCollection of Polygons or of Points, a JSON list of [x, y], CSV with columns x and y (or x_mm,
// y_mm; centroid_x, centroid_y; without a header the first two), or an SVG that this program wrote. kInvalidInput for
// anything else.
Result<PatternFile> read_pattern_file(std::string_view bytes);

}  // namespace tessera
