// A sheet of pieces as a thing to hold in one's hand.
#pragma once

#include "tessera/geometry/piece.h"
#include "tessera/geometry/scene.h"

namespace tessera {

// Each piece a closed slab with bevelled upper sides, of its own colour; they stand in a bed of grout. Two nodes: the
// pieces as one mesh, named after their layer, and `grout`. x to the right, z down the sheet, y up; its middle is at
// the origin, the bed's underside at y = 0. Without width_mm 1 px is 1 mm. Slabs are as thick as `kSlabs` says.
Scene extruded(const PieceSheet& sheet);

// In shares of a square's side that has the pieces' mean area. A piece with a hole, or too narrow, has less bevel or
// none.
struct SlabShape {
  double thickness, bevel, sunk, bed;
};
inline constexpr SlabShape kSlabs{.thickness = 0.3, .bevel = 0.05, .sunk = 0.2, .bed = 0.3};

}  // namespace tessera
