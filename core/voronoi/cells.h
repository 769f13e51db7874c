// Mending a label map so that each cell is one connected piece of pixels.
#pragma once

#include "tessera/voronoi/rasterizer.h"

namespace tessera {

// Leaves every label 4-connected and every pixel labelled. A cell keeps its largest part (the first in reading order
// among equals); each other part, and each unlabelled patch, goes to the cell of its zone with which it shares the
// longest border. Where there is none, it becomes a cell of its own: such new labels are appended from `cells` on, their
// zone being that of their pixels. Returns the new number of cells. Labels range over -1 .. cells - 1 and never cross
// zones.
int connect_cells(LabelMap& labels, const cv::Mat1b& zones, int cells);

}  // namespace tessera
