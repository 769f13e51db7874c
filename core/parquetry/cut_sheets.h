// Drawings for the cutter, and for the hands that put the pieces together (3.5).
#pragma once

#include <vector>

#include "tessera/geometry/drawing.h"
#include "tessera/parquetry/panel.h"
#include "tessera/parquetry/params.h"
#include "tessera/parquetry/pieces.h"

namespace tessera::parquetry {

struct CutSheet {
  Drawing drawing;       // layers engrave, fiducials, cut; strokes label-<id>, mark-<n>, cut-<id>
  double cut_mm = 0;     // the cuts' length
  double travel_mm = 0;  // between them
};

// What is cut from a panel, in the panel's true size: outlines moved outwards by half the kerf, holes before the
// outline around them, labels inside; seen from the side that the cutter sees, on the machine where the panel has
// been laid on it. `panel` is an index in the list of panels.
CutSheet cut_sheet(const std::vector<Panel>& panels, std::size_t panel, const std::vector<CutPiece>& pieces,
                   const Params& params);

// The finished piece of a target (counted from 1), outlines and labels, seen from the side that is assembled: the one
// that was cut, where the labels are. On pages of A4 where it is larger than one.
Drawing assembly(const std::vector<CutPiece>& pieces, int target, cv::Size size, double mm_per_px,
                 const Params& params);

}  // namespace tessera::parquetry
