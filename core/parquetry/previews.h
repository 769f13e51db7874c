// Pictures of what will come of it.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "tessera/geometry/raster.h"
#include "tessera/parquetry/panel.h"
#include "tessera/parquetry/pieces.h"

namespace tessera::parquetry {

// The finished piece of a target (counted from 1) at the panels' resolution; grey where wood is missing.
Raster finished_preview(const std::vector<Panel>& panels, const std::vector<CutPiece>& pieces, int target,
                        cv::Size size);
// The scan with its cuts drawn in, pale where it may not be cut.
Raster panel_preview(const std::vector<Panel>& panels, std::size_t panel, const std::vector<CutPiece>& pieces);

}  // namespace tessera::parquetry
