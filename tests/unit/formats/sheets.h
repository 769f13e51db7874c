// Small sheets for the writers' tests.
#pragma once

#include <cmath>

#include "tessera/base/rng.h"
#include "tessera/geometry/piece.h"

namespace tessera {

// Two stones on 20 x 10 px; the second has a hole.
inline PieceSheet two_stones() {
  PieceSheet sheet;
  sheet.kind = "stone";
  sheet.layer = "stones";
  sheet.width = 20;
  sheet.height = 10;
  sheet.grout = {1, 2, 255};
  sheet.pieces.push_back({1, {{{0.5, 0.25}, {9, 0.25}, {9, 9}, {0.5, 9}}, {}}, {0, 0, 0}});
  sheet.pieces.push_back(
      {17, {{{10, 1}, {18, 1}, {18, 9}, {10, 9}}, {{{12, 3}, {12, 5}, {15, 5}, {15, 3}}}}, {255, 250, 10}});
  return sheet;
}

// side x side pieces of 10 x 10 px with random corners and colours, which do not overlap; some have a hole.
inline PieceSheet random_sheet(unsigned seed, int side) {
  Rng rng(seed, RngPurpose::kShapes);
  PieceSheet sheet;
  sheet.kind = "tile";
  sheet.layer = "tiles";
  sheet.width = sheet.height = 10.0 * side;
  const auto channel = [&rng] { return static_cast<std::uint8_t>(rng.uniform(0, 256)); };
  for (int id = 0; id < side * side; ++id) {
    const Point corner{10.0 * (id % side), 10.0 * (id / side)};
    const auto near = [&](double x, double y) {
      const double dx = rng.uniform(), dy = rng.uniform();
      return corner + Point{x + dx, y + dy};
    };
    Piece piece;
    piece.id = id;
    piece.outline.outer = {near(0, 0), near(9, 0), near(9, 9), near(0, 9)};
    if (id % 3 == 0) piece.outline.holes.push_back({near(3, 3), near(6, 3), near(4, 6)});
    piece.fill = {channel(), channel(), channel()};
    sheet.pieces.push_back(piece);
  }
  return sheet;
}

}  // namespace tessera
