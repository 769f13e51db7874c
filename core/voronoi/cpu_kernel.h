// What the vectorised kernel needs of the world: plain arrays. See cpu_rasterizer.cpp for how it is used.
#pragma once

#include <cstdint>

#include "tessera/voronoi/rasterizer.h"
#include "tessera/voronoi/site_bins.h"

namespace tessera {

// A tile is labelled from one list of candidates; its blocks narrow the list further.
inline constexpr int kTileWidth = 16, kTileHeight = 8;
inline constexpr int kBlockWidth = 8, kBlockHeight = 4;

struct KernelArguments {
  const SiteBins* bins;
  const std::uint8_t* zones;  // padded to whole tiles by repeating the last column and row
  std::ptrdiff_t zones_stride;
  Metric metric;
  float reach;
  std::int32_t* labels;
  std::ptrdiff_t labels_stride;  // in elements
  int width, height;
};

// Labels the tile rows [begin, end).
void label_tile_rows(const KernelArguments& arguments, int begin, int end);

}  // namespace tessera
