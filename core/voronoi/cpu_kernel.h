// What the vectorised kernel needs of the world: plain arrays. See cpu_rasterizer.cpp for how it is used.
#pragma once

#include <cstdint>

#include "tessera/voronoi/rasterizer.h"
#include "tessera/voronoi/site_bins.h"

namespace tessera {

// Sites are drawn into tiles that fit the first cache. Tiles that drawing left incomplete are searched for in smaller
// ones, each with one list of candidates; blocks narrow the list further.
inline constexpr int kTileWidth = 64, kTileHeight = 32;
inline constexpr int kTilePadding = 16;  // pixels that vectors may reach beyond the last tile of a row
inline constexpr int kSearchWidth = 16, kSearchHeight = 8;
inline constexpr int kBlockWidth = 8, kBlockHeight = 4;

// The distance up to which sites are drawn. The box of the pixels around a site has half sides of `scale` times those
// of the box around its cap, plus `margin`.
struct NearDistance {
  float distance, scale, margin;
};

struct KernelArguments {
  const SiteBins* bins;
  const std::uint8_t* zones;  // padded to whole tiles, and kTilePadding, by repeating the last column and row
  std::ptrdiff_t zones_stride;
  const std::uint8_t* mixed_tiles;  // for each tile whether it has more than one zone, row by row
  Metric metric;
  NearDistance near;
  float reach;
  std::int32_t* labels;
  std::ptrdiff_t labels_stride;  // in elements
  int width, height;
};

// Labels the tile rows [begin, end).
void label_tile_rows(const KernelArguments& arguments, int begin, int end);

}  // namespace tessera
