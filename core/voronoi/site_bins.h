// Sites sorted into square bins, as arrays a vector unit can walk: a run of bins in a row is one range.
#pragma once

#include <cstdint>
#include <vector>

#include "tessera/voronoi/site.h"

namespace tessera {

// Positions are whole numbers of kSubpixels a pixel: a difference of two is exact, however large the canvas is.
inline constexpr int kSubpixels = 1024;

struct SiteBins {
  double bin = 8;  // side of a bin, px
  int columns = 0, rows = 0;
  std::vector<int> first;  // columns * rows + 1: where each bin begins in the arrays below
  // One entry a site, in bin order, padded at the end so that a vector may read past the last one.
  std::vector<std::int32_t> x, y;  // in 1 / kSubpixels px
  std::vector<float> cosine, sine, extent_u, extent_v;
  std::vector<float> box_x, box_y;  // half sides of the upright box around a cap, px
  std::vector<std::int32_t> zone, id;
  std::vector<int> place;  // of each site in these arrays
  float box_max = 0;       // largest of box_x, box_y
  float extent_max = 0;    // largest distance from a site to the border of its cap

  void build(const Sites& sites, int width, int height);
  int bin_of(double position, int count) const;

 private:
  void put(std::size_t k, const Site& site);
};

}  // namespace tessera
