// What the cells of a mosaic are like: numbers, areas, perimeters, sides.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "tessera/geometry/polygon.h"
#include "tessera/points/window.h"

namespace tessera::statistics {

// Of the typical cell. Cells that the window cuts are left out, and large ones, which it cuts more often, count for
// more: a cell of a bounding box w x h by 1 / ((W - w)(H - h)) (Miles 1974).
struct Moment {
  double mean = 0, variance = 0, error = 0;  // `error` of the mean, as if cells were independent
};
struct Weighted {
  double value, weight;
};
struct CellStatistics {
  int cells = 0, inner = 0;  // all, and those that the window does not cut
  double per_area = 0;       // cells a unit of area
  Moment area, perimeter, sides;
  std::vector<Weighted> areas;      // of the inner cells, the least first
  std::vector<double> side_shares;  // of cells with that many sides, from 0
};

CellStatistics cell_statistics(const std::vector<Ring>& cells, const Window& window);

// The number of the cell at each pixel's centre, -1 where there is none; pixels of `size` units.
cv::Mat1i draw_cells(const std::vector<Ring>& cells, const Window& window, double size);

}  // namespace tessera::statistics
