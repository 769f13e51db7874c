// Stones on their sheet: the last step.
#pragma once

#include <vector>

#include "tessera/pavement/diagram.h"
#include "tessera/pavement/run.h"

namespace tessera::pavement {

PieceSheet empty_sheet(cv::Size drawing, const Params& params);

// Source pixels, grout, colour; stones without area are left out. `rings`: one a cell, in pixels of the fields;
// `vertices_before`: as of Output, one a cell.
void lay_stones(std::vector<Ring> rings, const std::vector<int>& vertices_before, const Diagram& diagram,
                const Fields& fields, const Params& params, Output& output);

}  // namespace tessera::pavement
