#include "tessera/parquetry/shape.h"

#include <algorithm>

#include "tessera/geometry/offset.h"
#include "tessera/parquetry/spacing.h"

namespace tessera::parquetry {

namespace {

// `first`, and those whose discs are farthest from the discs before them.
std::vector<Shape::Place> spread(const std::vector<Shape::Place>& inside, const Shape::Place& first) {
  constexpr int kMost = 8;
  std::vector<Shape::Place> chosen{first};
  std::vector<double> farness(inside.size(), 1e9);
  while (static_cast<int>(chosen.size()) < kMost) {
    std::size_t best = 0;
    for (std::size_t i = 0; i < inside.size(); ++i) {
      const cv::Point way = kGroup * (inside[i].group - chosen.back().group);
      const double apart = length({static_cast<double>(way.x), static_cast<double>(way.y)});
      farness[i] = std::min(farness[i], apart + inside[i].depth - chosen.back().depth);
      if (farness[i] > farness[best]) best = i;
    }
    if (!(farness[best] > kGroup)) break;
    chosen.push_back(inside[best]);
  }
  return chosen;
}

}  // namespace

Shape shape_of(const Patch& patch, double half_kerf) {
  Shape shape;
  shape.size = patch.box.size();
  const Point corner{static_cast<double>(patch.box.x), static_cast<double>(patch.box.y)};
  shape.middle = corner + Point{0.5 * shape.size.width, 0.5 * shape.size.height};
  shape.cut = grown(patch.outline, half_kerf);
  for (const Point p : shape.cut.outer) shape.reach = std::max(shape.reach, length(p - shape.middle));
  std::vector<Shape::Place> inside;
  for (int y = 0; y * kGroup < shape.size.height; ++y)
    for (int x = 0; x * kGroup < shape.size.width; ++x) {
      const Point p = corner + Point{static_cast<double>(x * kGroup), static_cast<double>(y * kGroup)};
      const double depth = contains(shape.cut.outer, p) ? distance_to_sides(shape.cut.outer, p) : 0;
      if (depth > 0) inside.push_back({{x, y}, depth});
      if (depth <= shape.depth) continue;
      shape.depth = depth;
      shape.deep = {x, y};
    }
  if (shape.depth > 0) shape.places = spread(inside, {shape.deep, shape.depth});
  return shape;
}

Polygon cut_at(const Shape& shape, const Turn& turn, int rotation, cv::Point at) {
  return on_panel(place(turn, rotation, shape.size, at, shape.middle), shape.cut);
}

}  // namespace tessera::parquetry
