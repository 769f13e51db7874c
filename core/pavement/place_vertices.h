// From the diagram's pixels to a tessellation with sub-pixel vertices (paper, III.C, first half).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tessera/geometry/planar_map.h"
#include "tessera/pavement/diagram.h"
#include "tessera/pavement/fields.h"

namespace tessera::pavement {

// How a vertex may move.
enum class Freedom : std::uint8_t {
  kFree,      // among stones of one zone
  kFrontier,  // along the frontier between two zones
  kBorder,    // along the picture's border
  kFixed,     // not at all
};

struct Tessellation {
  PlanarMap map;                 // pixels of the diagram; cell c is the diagram's label c
  std::vector<Freedom> freedom;  // one a vertex
  std::vector<Point> normal;     // unit vector across the frontier or border a vertex is bound to, else (0, 0)
  std::vector<std::array<std::uint8_t, 2>> between;  // the zones on both sides of a vertex on a frontier
  std::vector<std::uint8_t> zone;                    // one a cell
  int cells() const { return map.cells(); }
};

// The paper puts vertices at pixel corners, which makes every stone favour the axes, and sorts them by angle, which
// takes cells to be star-shaped. Here a vertex among stones of one zone solves for equal distance from its sites, one
// on a frontier lies on the half-way contour of the source, and outlines are traced. Corners of the drawing become
// vertices; cells with fewer than four vertices are given more.
Tessellation place_vertices(const Diagram& diagram, const Fields& fields);

// Moves p along the gradient onto the frontier between zones a and b. Returns false, p unchanged, where there is none
// within `limit` pixels.
bool to_frontier(const Zones& zones, int a, int b, double limit, Point& p);

}  // namespace tessera::pavement
