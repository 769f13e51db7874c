// Lloyd iterations on a label map: centroids, and how a run may be watched.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "tessera/base/colour.h"
#include "tessera/voronoi/rasterizer.h"

namespace tessera {

// The diagram after a labelling, valid during the observer's call only.
struct Iteration {
  int index;     // 0 is the diagram of the first sites
  int last;      // the index of the final diagram
  double scale;  // diagram pixels a source pixel
  const Sites& sites;
  const LabelMap& labels;
  const std::vector<Rgb>& palette;  // colour of each zone
};

using IterationObserver = std::function<void(const Iteration& iteration)>;

// Sums over the pixels of a cell, exact, so that they do not depend on the order of summation.
struct CellMoments {
  std::int64_t count = 0;  // pixels
  std::int64_t sum_x = 0;  // of pixel indices; a centre is half a pixel further
  std::int64_t sum_y = 0;

  double centroid_x() const { return static_cast<double>(sum_x) / static_cast<double>(count) + 0.5; }
  double centroid_y() const { return static_cast<double>(sum_y) / static_cast<double>(count) + 0.5; }
};

// Sums over all cells of one label map after another, in memory that is taken once.
class CellSums {
 public:
  // One entry a site; an empty cell has count 0. Valid until the next call. `labels` holds values of -1 (ignored) to
  // cells - 1.
  const std::vector<CellMoments>& of(const LabelMap& labels, int cells);

 private:
  std::vector<std::vector<CellMoments>> partial_;  // one a stripe of rows
};

// The same, once.
std::vector<CellMoments> cell_moments(const LabelMap& labels, int cells);

// Gives each empty cell's site a place beside that of one of the largest cells of its zone. Returns how many moved.
int reseed_empty(Sites& sites, const std::vector<CellMoments>& moments);

// The same among the cells whose sites lie within `reach` px, so that no part of a picture depends on a far one; a
// site that has none stays where it is.
int reseed_empty_near(Sites& sites, const std::vector<CellMoments>& moments, double reach);

}  // namespace tessera
