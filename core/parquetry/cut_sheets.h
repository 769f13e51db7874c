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

// The finished pieces of all targets side by side, outlines and labels, and with dashes what is missing; each seen
// from the side that is assembled: the one that was cut, where the labels are. Layers missing, outlines, labels;
// strokes missing-<id>, piece-<id>, label-<id>. On pages of A4, each target on its own, where one page is not enough.
Drawing assembly(const std::vector<CutPiece>& pieces, const std::vector<MissingPiece>& missing,
                 const std::vector<cv::Size>& targets, double mm_per_px, const Params& params);

}  // namespace tessera::parquetry
