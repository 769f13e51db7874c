#include "tessera/formats/formats.h"
#include "tessera/formats/measures.h"
#include "tessera/formats/text.h"

namespace tessera {
namespace {

void append_position(std::string& out, Point p) {
  out += '[';
  append_point(out, p, ',');
  out += ']';
}

// RFC 7946, section 3.1.6: the first position is repeated at the end; outer rings have positive area, holes negative.
void append_ring(std::string& out, const Ring& ring, bool positive) {
  const std::size_t n = ring.size();
  const bool reversed = (signed_area(ring) > 0) != positive;
  out += '[';
  for (std::size_t i = 0; i <= n; ++i) {
    const std::size_t k = i % n;
    if (i != 0) out += ',';
    append_position(out, ring[reversed && k != 0 ? n - k : k]);
  }
  out += ']';
}

void append_properties(std::string& out, const PieceSheet& sheet, std::size_t index) {
  const Piece& piece = sheet.pieces[index];
  const Measures m = measure(piece.outline);
  out += "{\"id\":\"";
  append_piece_id(out, sheet, piece);
  out += "\",\"colour\":\"";
  append_colour(out, piece.fill);
  out += "\",\"area\":";
  append_number(out, m.area);
  out += ",\"vertices\":";
  append_integer(out, static_cast<std::int64_t>(m.vertices));
  out += ",\"orientation\":";
  append_number(out, m.orientation);
  out += ",\"centroid\":";
  append_position(out, m.centroid);
  for (const Column& column : sheet.columns) {
    out += ",\"" + column.name + "\":";
    append_number(out, column.values[index]);
  }
  out += '}';
}

void append_feature(std::string& out, const PieceSheet& sheet, std::size_t index) {
  const Piece& piece = sheet.pieces[index];
  out += "{\"type\":\"Feature\",\"properties\":";
  append_properties(out, sheet, index);
  if (sheet.points) {
    out += ",\"geometry\":{\"type\":\"Point\",\"coordinates\":";
    append_position(out, measure(piece.outline).centroid);
    out += "}}";
    return;
  }
  out += ",\"geometry\":{\"type\":\"Polygon\",\"coordinates\":[";
  append_ring(out, piece.outline.outer, true);
  for (const Ring& hole : piece.outline.holes) {
    out += ',';
    append_ring(out, hole, false);
  }
  out += "]}}";
}

}  // namespace

std::string write_geojson(const PieceSheet& sheet) {
  std::string out;
  out.reserve(256 + room_for(sheet, 230 + sheet.kind.size(), 20));
  out += "{\"type\":\"FeatureCollection\",\"bbox\":[0,0,";
  append_point(out, {sheet.width, sheet.height}, ',');
  out += "],\"features\":[";
  const char* separator = "\n";
  for (std::size_t i = 0; i < sheet.pieces.size(); ++i) {
    out += separator;
    append_feature(out, sheet, i);
    separator = ",\n";
  }
  out += "\n]}\n";
  return out;
}

}  // namespace tessera
