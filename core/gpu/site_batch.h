// The sites that matter to one tile of the canvas, in the order and form in which they are drawn.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "tessera/voronoi/site.h"

namespace tessera {

// Laid out for GL: attributes of an instance, and two texels of four floats.
struct SiteRecord {
  float x, y;  // px, relative to the tile's top left corner
  float cosine, sine;
  float extent_u, extent_v;
  float zone;
  float label;  // index in the caller's list, below 2^24
};

// Records of one zone: [first, first + count).
struct ZoneRun {
  std::uint8_t zone;
  int first, count;
};

// A record's place is its slot. Within a zone, slots are in the order of labels, so that a tie between slots is one
// between labels.
struct SiteBatch {
  std::vector<SiteRecord> records;
  std::vector<ZoneRun> runs;
  double lowest = 0;  // least distance that occurs, at the middle of a rectangle; at most 0
  double reach = 0;   // how far to draw: a pixel more than sites reach, but not beyond the tile's far end
};

// `tile` is in pixels of the label map. Leaves out sites out of reach of it.
SiteBatch gather_sites(const Sites& sites, Metric metric, double reach, const cv::Rect& tile);

}  // namespace tessera
