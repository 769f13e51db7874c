// Seams as curves that a machine can follow (3.4), and pieces that share them.
#pragma once

#include <vector>

#include "tessera/geometry/bezier.h"
#include "tessera/parquetry/seams.h"

namespace tessera::parquetry {

// What of a seam is between two crossings; both pieces beside it have the same.
struct SeamEdge {
  Ring cut;  // the seam through the middles of its pixels' sides, evened out by less than half a pixel
  std::vector<Bezier> curves;  // near to that, from crossing to crossing
  Ring flat;                   // points of these, its ends among them
};

// Adds the points of an edge but its last one, from its end on where it goes backwards.
void append(const Ring& edge, bool backwards, Ring& ring);

// All edges of a target's pieces, px of the target.
struct SeamNetwork {
  int across = 0, down = 0;       // pieces
  std::vector<SeamEdge> columns;  // [line * down + row], from the top
  std::vector<SeamEdge> rows;     // [line * across + column], from the left

  const SeamEdge& column(int line, int row) const { return columns[line * down + row]; }
  const SeamEdge& row(int line, int column) const { return rows[line * across + column]; }
  // Of a piece, clockwise on the screen.
  Ring outline(int column, int row) const;
};

// `error`: px, how far curves may be from the cuts. With kG1 a seam goes on in one direction where others cross it.
SeamNetwork network_of(const Grid& grid, const Seams& seams, double error, Joints joints);

}  // namespace tessera::parquetry
