#include "tessera/parquetry/shape.h"

#include <algorithm>

#include "tessera/geometry/offset.h"
#include "tessera/parquetry/spacing.h"

namespace tessera::parquetry {

Shape shape_of(const Patch& patch, double half_kerf) {
  Shape shape;
  shape.size = patch.box.size();
  const Point corner{static_cast<double>(patch.box.x), static_cast<double>(patch.box.y)};
  shape.middle = corner + Point{0.5 * shape.size.width, 0.5 * shape.size.height};
  shape.cut = grown(patch.outline, half_kerf);
  for (const Point p : shape.cut.outer) shape.reach = std::max(shape.reach, length(p - shape.middle));
  for (int y = 0; y * kGroup < shape.size.height; ++y)
    for (int x = 0; x * kGroup < shape.size.width; ++x) {
      const Point p = corner + Point{static_cast<double>(x * kGroup), static_cast<double>(y * kGroup)};
      const double depth = contains(shape.cut.outer, p) ? distance_to_sides(shape.cut.outer, p) : 0;
      if (depth <= shape.depth) continue;
      shape.depth = depth;
      shape.deep = {x, y};
    }
  return shape;
}

Polygon cut_at(const Shape& shape, const Turn& turn, int rotation, cv::Point at) {
  return on_panel(place(turn, rotation, shape.size, at, shape.middle), shape.cut);
}

}  // namespace tessera::parquetry
