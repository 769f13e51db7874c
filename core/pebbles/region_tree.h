// Regions joined two by two until one is left, and which of them are pebbles.
#pragma once

#include <cstdint>
#include <vector>

#include "tessera/geometry/polygon.h"
#include "tessera/pebbles/watershed.h"

namespace tessera::pebbles {

// Sums over a region's pixels, exact.
struct Moments {
  std::int64_t count = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;  // of pixel indices
  Moments& operator+=(const Moments& other);
  // Area of the ellipse with the same second moments, px^2.
  double ellipse_area() const;
};

struct Region {
  Moments moments;
  int left = -1, right = -1;  // the two it was joined of; -1: a basin of its own
  int parent = -1;
  double joined_at = 0;     // mean strength of the border between the two; 0 for a basin
  double hull_area = 0;     // px^2, of its pixels' corners
  std::int64_t border = 0;  // picture border pixels
};

// Regions 0 to basins.count - 1 are the basins, the others follow in the order they were joined: always the two with
// the least mean strength along their common border.
std::vector<Region> region_tree(const Basins& basins, const cv::Mat1w& strength);

// Area of the convex hull of the pixels of each label 0 to count - 1, px^2; 0 of a label without pixels.
std::vector<double> hull_areas(const cv::Mat1i& labels, int count);

}  // namespace tessera::pebbles
