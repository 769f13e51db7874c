// What of a patch decides where it finds room.
#pragma once

#include <vector>

#include "tessera/parquetry/frames.h"
#include "tessera/parquetry/patch.h"

namespace tessera::parquetry {

inline constexpr int kGroup = 4;  // px: positions are looked at in squares of this side first

struct Shape {
  cv::Size size;     // of the patch's box
  Point middle;      // of the box, on the target
  Polygon cut;       // where it is cut, on the target: the outline grown by half the kerf
  double reach = 0;  // of `cut` from `middle`, px
  cv::Point deep;    // a place inside, from the top left corner of the box, in groups: the farthest from the sides
  double depth = 0;  // its distance to the sides of `cut`, px; 0 where no such place is inside

  struct Place {
    cv::Point group;
    double depth;  // > 0
  };
  // Several such places, the deepest first, the next as far as can be from all before: where they have no room, the
  // shape has none, be it long or bent. None where none is inside.
  std::vector<Place> places;
};

// `half_kerf`: px, >= 0.
Shape shape_of(const Patch& patch, double half_kerf);

// Where it is cut from a panel.
Polygon cut_at(const Shape& shape, const Turn& turn, int rotation, cv::Point at);

}  // namespace tessera::parquetry
