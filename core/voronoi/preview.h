// A diagram on its way, small enough to be watched.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "tessera/voronoi/lloyd.h"

namespace tessera {

// A pixel of Preview::cells: the zone, and whether a border lies between it and its neighbour to the right or below.
inline constexpr std::uint8_t kPreviewZone = 0x3f;
inline constexpr std::uint8_t kPreviewCellBorder = 0x80;
inline constexpr std::uint8_t kPreviewZoneBorder = 0x40;

struct Preview {
  cv::Mat1b cells;
  std::vector<float> sites;  // four numbers each: x, y in source pixels, angle in radians, zone
};

// Every n-th pixel and every m-th site, the smallest n and m that keep to the limits (both at least 1).
Preview make_preview(const Iteration& iteration, int max_pixels, int max_sites);

}  // namespace tessera
