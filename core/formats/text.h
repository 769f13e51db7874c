// How numbers, colours and foreign text are written, the same in every format. All append to `out`.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "tessera/geometry/piece.h"

namespace tessera {

// At most 3 decimals, rounded to the nearest, without trailing zeros, sign of zero or exponent; finite.
void append_number(std::string& out, double value);
void append_integer(std::string& out, std::int64_t value);
// #rrggbb
void append_colour(std::string& out, Rgb colour);
// "x y" with `separator` between.
void append_point(std::string& out, Point p, char separator);
// <kind>-<id>, by which a piece goes in every format.
void append_piece_id(std::string& out, const PieceSheet& sheet, const Piece& piece);
// UTF-8 text as XML character data. Characters that XML forbids become U+FFFD.
void append_xml(std::string& out, std::string_view text);

// Room to reserve for a file: so much a piece and so much a vertex.
std::size_t room_for(const PieceSheet& sheet, std::size_t per_piece, std::size_t per_vertex);

}  // namespace tessera
