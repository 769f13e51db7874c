// What every technique ends in: coloured pieces on a sheet. The formats know nothing else.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tessera/base/colour.h"
#include "tessera/geometry/polygon.h"

namespace tessera {

struct Piece {
  int id = 0;  // unique on its sheet; written as "<kind>-<id>"
  Polygon outline;
  Rgb fill;
  std::uint8_t opacity = 255;  // of the fill, on sheets with a channel for it
};

// A colour that pieces can be bought in.
struct Material {
  std::string name;
  Rgb colour;
};

// What else has been measured of every piece.
struct Column {
  std::string name;            // "a_mm"
  std::vector<double> values;  // one a piece, finite
};

struct PieceSheet {
  std::string kind = "piece";    // class of a piece, and stem of its id: stone, tile, cell
  std::string layer = "pieces";  // name of the pieces' layer: stones, tiles, cells
  double width = 0, height = 0;  // source pixels
  bool points = false;           // a piece stands for the point in its middle
  bool seamless = false;         // tiles the plane: what sticks out at one side belongs to the other as well
  double width_mm = 0;           // physical width of the sheet; 0: none given
  Rgb grout{128, 128, 128};      // colour between the pieces
  std::uint8_t grout_opacity = 255;
  int channels = 3;  // of its picture: 1 grey (red, green and blue are alike), 2 with opacity, 3 RGB, 4 with opacity
  std::string job_json;          // the job that made it, one JSON object; empty: none
  std::vector<Piece> pieces;
  std::vector<Column> columns;      // of tables, behind those that every sheet has
  std::vector<Material> materials;  // names of fills, for a bill; empty: the fills have none
};

}  // namespace tessera
