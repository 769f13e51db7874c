#include "tessera/formats/formats.h"
#include "tessera/formats/measures.h"
#include "tessera/formats/text.h"

namespace tessera {

std::string write_csv(const PieceSheet& sheet) {
  std::string out;
  out.reserve(128 + room_for(sheet, 80 + sheet.kind.size(), 0));
  out += "id,colour,area_px2,perimeter_px,vertices,orientation_deg,centroid_x,centroid_y";
  for (const Column& column : sheet.columns) out += "," + column.name;
  out += '\n';
  for (std::size_t i = 0; i < sheet.pieces.size(); ++i) {
    const Piece& piece = sheet.pieces[i];
    const Measures m = measure(piece.outline);
    append_piece_id(out, sheet, piece);
    out += ',';
    append_colour(out, piece.fill);
    for (const double value : {m.area, m.perimeter, static_cast<double>(m.vertices), m.orientation}) {
      out += ',';
      append_number(out, value);
    }
    out += ',';
    append_point(out, m.centroid, ',');
    for (const Column& column : sheet.columns) {
      out += ',';
      append_number(out, column.values[i]);
    }
    out += '\n';
  }
  return out;
}

}  // namespace tessera
