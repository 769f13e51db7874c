// The edges of a morphed grid as curves (3.4, a-priori refinement), and cells that share them.
#pragma once

#include <vector>

#include "tessera/parquetry/edge_picture.h"
#include "tessera/parquetry/morphing_grid.h"
#include "tessera/parquetry/seam_curves.h"

namespace tessera::parquetry {

// An additional edge that cuts a cell into two triangles.
struct Diagonal {
  enum class Way {
    kNone,
    kFalling,
    kRising
  };  // from the top left corner to the bottom right one; from the bottom
      // left to the top right
  Way way = Way::kNone;
  SeamEdge edge;  // from its upper end to its lower one
};

// All edges between the vertices, px of the target. An edge that follows the picture has the line that its curves are
// fitted to as its `cut`; others have none.
struct MorphedCells {
  SeamNetwork network;
  std::vector<Diagonal> diagonals;  // of each cell, row by row

  const Diagonal& diagonal(int column, int row) const { return diagonals[row * network.across + column]; }
  // The cell, or its two triangles, the upper one first; clockwise on the screen.
  std::vector<Ring> outlines(int column, int row) const;
};

struct CurveLimits {
  double error = 0.5;       // > 0; how far curves may be from the lines they follow
  double least_width = 10;  // of a piece: of its roomiest place and its necks; nor may it have long tails
};

// Edges where the picture has some are fitted to these; those between them go on smoothly (G2), those on the borders
// are straight. What would cross another edge, leave the target or make a piece too narrow is made straight.
MorphedCells cells_of(const MorphingGrid& grid, const EdgePicture& edges, const CurveLimits& limits);

}  // namespace tessera::parquetry
