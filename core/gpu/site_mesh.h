// The template that is drawn once a site.
#pragma once

#include <cstdint>
#include <vector>

#include "tessera/voronoi/site.h"

namespace tessera {

// Laid out for GL; shaders/site.vert says how a site stretches it.
struct MeshVertex {
  float corner_u, corner_v;        // signs, or 0: which corner of the rectangle it belongs to
  float direction_u, direction_v;  // from that corner outwards, 0 on the rectangle
  float level;                     // -1 on the ridge inside, 0 on the border, 1 at the end of the reach
};

struct SiteMesh {
  std::vector<MeshVertex> vertices;
  std::vector<std::uint16_t> triangles;  // three indices each
  float coverage = 1;                    // the roof ends no nearer than this part of the reach it is drawn with
};

// kFrustum: a hip roof below zero inside the rectangle, slopes of 1 outside, cones of `segments` facets at each
// corner. kChebyshev: a pyramid upside down.
SiteMesh site_mesh(Metric metric, int segments);

}  // namespace tessera
