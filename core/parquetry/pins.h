// Vertices of a morphed grid that somebody has laid, as people write them.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tessera/geometry/point.h"

namespace tessera::parquetry {

// Vertices are counted from 0, those on the borders among them.
struct Pin {
  int column = 0, row = 0;
  Point at;
};

// "3,4:123.5,87.2; 5,4:150,88": column, row and place in mm from the finished piece's top left corner.
// report(message) hears of everything that is wrong, one line each.
std::vector<Pin> read_pins(std::string_view text, const std::function<void(std::string)>& report = {});
// The same backwards, to a hundredth of a millimetre.
std::string write_pins(const std::vector<Pin>& pins);

}  // namespace tessera::parquetry
