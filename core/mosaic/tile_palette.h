// The colours that tiles are to be had in, as a person writes them down.
#pragma once

#include <string>
#include <vector>

#include "tessera/geometry/piece.h"

namespace tessera::mosaic {

struct TilePalette {
  int count = 0;                    // so many of the picture's own; 0: the list
  std::vector<Material> materials;  // both empty: no palette
};

// "", "12", or entries of an optional name and a colour, commas, semicolons or line ends between: "chalk #f4f1e8,
// #8c4a32". False where the text is none of these, has more than 1024 colours, or a number that is not 2 to 256.
bool parse_palette(const std::string& text, TilePalette& palette);

}  // namespace tessera::mosaic
