// Cells that share sub-pixel vertices, on their way to pieces with four corners.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tessera/geometry/planar_map.h"

namespace tessera {

// How a vertex may move.
enum class Freedom : std::uint8_t {
  kFree,      // among pieces of one zone
  kFrontier,  // along the frontier between two zones, or along an edge
  kBorder,    // along the picture's border
  kFixed,     // not at all
};

struct Tessellation {
  PlanarMap map;                 // pixels of the diagram; cell c is the diagram's label c
  std::vector<Freedom> freedom;  // one a vertex
  std::vector<Point> normal;     // unit vector across the frontier or border a vertex is bound to, else (0, 0)
  std::vector<std::array<std::uint8_t, 2>> between;  // the zones on both sides of a vertex on a frontier
  std::vector<std::uint8_t> zone;                    // one a cell
  std::vector<float> half_side;                      // one a cell: h, what its lengths are measured by; > 0
  // Empty, or one a cell: unit vector along which two of the piece's four sides shall lie, the other two across it.
  std::vector<Point> frame;
  int cells() const { return map.cells(); }

  void set_vertices(std::size_t n) {
    map.vertices.resize(n);
    freedom.resize(n);
    normal.resize(n);
    between.resize(n);
  }
};

}  // namespace tessera
