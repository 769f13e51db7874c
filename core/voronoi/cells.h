// Mending a label map so that each cell is one connected piece of pixels.
#pragma once

#include <vector>

#include "tessera/voronoi/rasterizer.h"

namespace tessera {

// Pixels of one label and zone side by side in a row; runs are maximal but where a label has changed.
struct CellRun {
  int label;
  int begin, end;  // columns
  int y;
};

struct CellRuns {
  std::vector<CellRun> all;    // in reading order
  std::vector<int> row_first;  // where each row begins; one more at the end
  std::vector<int> changed;    // runs whose label is not the map's any more
};

// Leaves every label 4-connected and every pixel labelled. A cell keeps its largest part (the first in reading order
// among equals); each other part, and each unlabelled patch, goes to the cell of its zone with which it shares the
// longest border. Where there is none, it becomes a cell of its own: such new labels are appended from `cells` on,
// their zone being that of their pixels. Returns the new number of cells. Labels range over -1 .. cells - 1 and never
// cross zones.
int connect_cells(LabelMap& labels, const cv::Mat1b& zones, int cells);

// The same, told by runs instead of done to the map; `cells` grows by the new ones.
CellRuns connected_runs(const LabelMap& labels, const cv::Mat1b& zones, int& cells);

}  // namespace tessera
