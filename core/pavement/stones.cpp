#include "tessera/pavement/stones.h"

#include <cmath>
#include <opencv2/core/utility.hpp>

#include "tessera/tessellation/separate.h"

namespace tessera::pavement {

PieceSheet empty_sheet(cv::Size drawing, const Params& params) {
  PieceSheet sheet;
  sheet.kind = "stone";
  sheet.layer = "stones";
  sheet.width = drawing.width;
  sheet.height = drawing.height;
  sheet.width_mm = params.width_mm;
  sheet.grout = {150, 146, 138};
  return sheet;
}

void lay_stones(std::vector<Ring> rings, const std::vector<int>& vertices_before, const Diagram& diagram,
                const Fields& fields, const Params& params, Output& output) {
  constexpr double kLeastArea = 0.01;  // px^2
  const Point origin{static_cast<double>(fields.origin.x), static_cast<double>(fields.origin.y)};
  cv::parallel_for_({0, static_cast<int>(rings.size())}, [&](const cv::Range& range) {
    for (int cell = range.start; cell < range.end; ++cell) {
      for (Point& p : rings[cell]) p = (1 / fields.scale) * (p + origin);
      shrink(rings[cell], params.grout, params.half_side);
    }
  });
  for (std::size_t cell = 0; cell < rings.size(); ++cell) {
    Ring& ring = rings[cell];
    const double size = std::fabs(signed_area(ring));
    if (ring.size() < 3 || size < kLeastArea) continue;
    output.vertices_before.push_back(vertices_before[cell]);
    output.vertices_after.push_back(static_cast<int>(ring.size()));
    output.areas.push_back(size);
    const int id = output.first_id + static_cast<int>(output.sheet.pieces.size());
    output.sheet.pieces.push_back({id, {std::move(ring), {}}, fields.zones.palette[diagram.cell_zone[cell]]});
  }
}

}  // namespace tessera::pavement
