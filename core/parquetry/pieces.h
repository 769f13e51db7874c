// Placed patches as pieces of wood with names and measures.
#pragma once

#include <string>
#include <vector>

#include "tessera/parquetry/panel.h"
#include "tessera/parquetry/params.h"
#include "tessera/parquetry/patch.h"

namespace tessera::parquetry {

struct CutPiece {
  std::string id;           // "C12": column C, row 12; a quarter "C12b"; of several targets "2-C12"
  int row = 0, column = 0;  // counted from 1
  int target = 0;           // counted from 1
  std::size_t panel = 0;    // index in the list of panels
  Polygon on_panel{};       // px of the panel, front, without kerf
  Polygon finished{};       // px of the target
  Point centroid_mm{};      // of on_panel
  double turn_deg = 0;      // clockwise from the panel to the finished piece
  double area_mm2 = 0;
  double min_width_mm = 0;  // diameter of its roomiest place; or its narrowest neck, if that is below minWidthMm
  std::int64_t cost = 0;
  double grain_deg = 0;  // of the finished piece's grain, from x towards y, [0, 180)
};

// A patch without wood.
struct MissingPiece {
  std::string id;  // as CutPiece has them
  int target = 0;
  Polygon finished{};
};

// "A", "Z", "AA" of a column counted from 0.
std::string column_letters(int column);

// What each patch is called.
std::vector<std::string> names_of(const std::vector<Patch>& patches);

// A piece a placement that has a panel, in the patches' order.
std::vector<CutPiece> pieces_of(const std::vector<Panel>& panels, const std::vector<Patch>& patches,
                                const std::vector<Placement>& placements, const Params& params = {});

// One a placement that has none.
std::vector<MissingPiece> missing_of(const std::vector<Patch>& patches, const std::vector<Placement>& placements);

// Where targets lie side by side, their tops in a line: the left edge of each, and the right one of the last, px.
std::vector<int> side_by_side(const std::vector<cv::Size>& targets);

}  // namespace tessera::parquetry
