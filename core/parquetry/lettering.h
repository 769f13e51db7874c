// Letters of single lines, as engravers draw them.
#pragma once

#include <string_view>

#include "tessera/geometry/point.h"
#include "tessera/geometry/polygon.h"

namespace tessera::parquetry {

// Open lines. The text's middle is (0, 0), capitals are 1 high. Of printable ASCII; other characters are blanks.
struct Lettering {
  std::vector<std::vector<Point>> lines;
  double width = 0, height = 0;  // of the lines' box
};
Lettering letter(std::string_view text);

// The text as large as there is room for in the roomiest place of the outline, at most `most_height` high, upright.
// All of it is inside, a tenth of the room away from the sides.
std::vector<std::vector<Point>> label_in(const Polygon& outline, std::string_view text, double most_height);

}  // namespace tessera::parquetry
