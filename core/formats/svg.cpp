#include "tessera/formats/formats.h"
#include "tessera/formats/text.h"

namespace tessera {
namespace {

void append_attribute(std::string& out, const char* name, double value, const char* unit = "") {
  out += ' ';
  out += name;
  out += "=\"";
  append_number(out, value);
  out += unit;
  out += '"';
}

void append_opening(std::string& out, const PieceSheet& sheet) {
  const bool physical = sheet.width_mm > 0;
  const double scale = physical ? sheet.width_mm / sheet.width : 1;
  const char* unit = physical ? "mm" : "px";
  out +=
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\""
      " xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" version=\"1.1\"";
  append_attribute(out, "width", sheet.width * scale, unit);
  append_attribute(out, "height", sheet.height * scale, unit);
  out += " viewBox=\"0 0 ";
  append_point(out, {sheet.width, sheet.height}, ' ');
  out += "\">\n";
}

void append_layer(std::string& out, const std::string& name) {
  out += "<g id=\"" + name + "\" inkscape:groupmode=\"layer\" inkscape:label=\"" + name + "\">\n";
}

void append_opacity(std::string& out, std::uint8_t opacity) {
  if (opacity == 255) return;
  out += "\" fill-opacity=\"";
  append_number(out, opacity / 255.0);
}

void append_grout(std::string& out, const PieceSheet& sheet) {
  append_layer(out, "grout");
  out += "<rect x=\"0\" y=\"0\"";
  append_attribute(out, "width", sheet.width);
  append_attribute(out, "height", sheet.height);
  out += " fill=\"";
  append_colour(out, sheet.grout);
  append_opacity(out, sheet.grout_opacity);
  out += "\"/>\n</g>\n";
}

void append_ring(std::string& out, const Ring& ring) {
  char command = 'M';
  for (const Point p : ring) {
    out += command;
    append_point(out, p, ' ');
    command = 'L';
  }
  out += 'Z';
}

void append_piece(std::string& out, const PieceSheet& sheet, const std::string& class_attribute, const Piece& piece) {
  out += "<path id=\"";
  append_piece_id(out, sheet, piece);
  out += class_attribute;
  append_colour(out, piece.fill);
  append_opacity(out, piece.opacity);
  out += piece.outline.holes.empty() ? "\" d=\"" : "\" fill-rule=\"evenodd\" d=\"";
  append_ring(out, piece.outline.outer);
  for (const Ring& hole : piece.outline.holes) append_ring(out, hole);
  out += "\"/>\n";
}

}  // namespace

std::string write_svg(const PieceSheet& sheet) {
  std::string out;
  out.reserve(1024 + 2 * sheet.job_json.size() + room_for(sheet, 72 + 2 * sheet.kind.size(), 17));
  append_opening(out, sheet);
  if (!sheet.job_json.empty()) {
    out += "<metadata>";
    append_xml(out, sheet.job_json);
    out += "</metadata>\n";
  }
  append_grout(out, sheet);
  append_layer(out, sheet.layer);
  const std::string class_attribute = "\" class=\"" + sheet.kind + "\" fill=\"";
  for (const Piece& piece : sheet.pieces) append_piece(out, sheet, class_attribute, piece);
  out += "</g>\n</svg>\n";
  return out;
}

}  // namespace tessera
