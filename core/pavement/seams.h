// Where tiles meet: stones laid already, as the tiles after them see them.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "tessera/pavement/diagram.h"
#include "tessera/tessellation/relax.h"

namespace tessera::pavement {

// The first pixel of each cell in reading order, in the drawing's diagram: a cell's name in every tile that sees all
// of it.
std::vector<cv::Point> first_pixels(const Diagram& diagram, cv::Point origin);

class Seams {
 public:
  // Remembers a cell of a tile that has been laid: where its vertices were placed and where they have come to, and
  // which match_corners() found flat.
  void keep(cv::Point first_pixel, const Tessellation& placed, const Tessellation& laid,
            const std::vector<char>& flat, int cell, cv::Point origin);
  // Where vertices of remembered cells are. These cells' flat vertices are those remembered, and no other cell's.
  std::vector<Pin> adopt(const std::vector<cv::Point>& first_pixels, cv::Point origin, const Tessellation& placed,
                         std::vector<char>& flat) const;
  // Forgets the cells that begin above a row.
  void forget_above(int row);

 private:
  struct Corner {
    Point placed, laid;  // in the drawing's diagram
    char flat;
  };
  std::map<std::pair<int, int>, std::vector<Corner>> cells_;  // by (y, x) of the first pixel
};

}  // namespace tessera::pavement
