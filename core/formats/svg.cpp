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

// The root element, and the job in it. `box` in the drawing's own units.
void append_opening(std::string& out, const Page& box, double scale, const char* unit, const std::string& job_json) {
  out +=
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\""
      " xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" version=\"1.1\"";
  append_attribute(out, "width", box.width * scale, unit);
  append_attribute(out, "height", box.height * scale, unit);
  out += " viewBox=\"";
  append_point(out, {box.left, box.top}, ' ');
  out += ' ';
  append_point(out, {box.width, box.height}, ' ');
  out += "\">\n";
  if (job_json.empty()) return;
  out += "<metadata>";
  append_xml(out, job_json);
  out += "</metadata>\n";
}

void append_layer(std::string& out, const std::string& name, const std::string& attributes = "") {
  out += "<g id=\"" + name + "\" inkscape:groupmode=\"layer\" inkscape:label=\"" + name + "\"" + attributes + ">\n";
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

void append_line(std::string& out, const Ring& line, bool closed = true) {
  char command = 'M';
  for (const Point p : line) {
    out += command;
    append_point(out, p, ' ');
    command = 'L';
  }
  if (closed) out += 'Z';
}

void append_piece(std::string& out, const PieceSheet& sheet, const std::string& class_attribute, const Piece& piece) {
  out += "<path id=\"";
  append_piece_id(out, sheet, piece);
  out += class_attribute;
  append_colour(out, piece.fill);
  append_opacity(out, piece.opacity);
  out += piece.outline.holes.empty() ? "\" d=\"" : "\" fill-rule=\"evenodd\" d=\"";
  append_line(out, piece.outline.outer);
  for (const Ring& hole : piece.outline.holes) append_line(out, hole);
  out += "\"/>\n";
}

// Inkscape's, which prints each on a sheet of paper.
void append_pages(std::string& out, const std::vector<Page>& pages) {
  if (pages.empty()) return;
  out += "<sodipodi:namedview xmlns:sodipodi=\"http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd\">\n";
  for (const Page& page : pages) {
    out += "<inkscape:page";
    append_attribute(out, "x", page.left);
    append_attribute(out, "y", page.top);
    append_attribute(out, "width", page.width);
    append_attribute(out, "height", page.height);
    out += "/>\n";
  }
  out += "</sodipodi:namedview>\n";
}

void append_drawing_layer(std::string& out, const DrawingLayer& layer) {
  std::string attributes = " fill=\"none\" stroke=\"";
  append_colour(attributes, layer.colour);
  attributes += '"';
  append_attribute(attributes, "stroke-width", layer.width);
  if (layer.dash > 0) append_attribute(attributes, "stroke-dasharray", layer.dash);
  append_layer(out, layer.name, attributes);
  for (const Stroke& stroke : layer.strokes) {
    out += "<path id=\"" + stroke.id + "\" d=\"";
    for (const Ring& line : stroke.lines) append_line(out, line, stroke.closed);
    out += "\"/>\n";
  }
  out += "</g>\n";
}

}  // namespace

std::string svg_head(const PieceSheet& sheet) {
  std::string out;
  const bool physical = sheet.width_mm > 0;
  append_opening(out, {0, 0, sheet.width, sheet.height}, physical ? sheet.width_mm / sheet.width : 1,
                 physical ? "mm" : "px", sheet.job_json);
  append_grout(out, sheet);
  append_layer(out, sheet.layer);
  return out;
}

void append_svg_pieces(std::string& out, const PieceSheet& sheet) {
  const std::string class_attribute = "\" class=\"" + sheet.kind + "\" fill=\"";
  for (const Piece& piece : sheet.pieces) append_piece(out, sheet, class_attribute, piece);
}

std::string svg_foot() { return "</g>\n</svg>\n"; }

std::string write_svg(const PieceSheet& sheet) {
  std::string out = svg_head(sheet);
  out.reserve(out.size() + 1024 + room_for(sheet, 72 + 2 * sheet.kind.size(), 17));
  append_svg_pieces(out, sheet);
  out += svg_foot();
  return out;
}

std::string write_svg(const Drawing& drawing) {
  std::string out;
  append_opening(out, {drawing.left, drawing.top, drawing.width, drawing.height}, 1, "mm", drawing.job_json);
  append_pages(out, drawing.pages);
  for (const DrawingLayer& layer : drawing.layers) append_drawing_layer(out, layer);
  out += "</svg>\n";
  return out;
}

}  // namespace tessera
