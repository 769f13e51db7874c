#include <algorithm>
#include <map>
#include <tuple>

#include "tessera/formats/formats.h"
#include "tessera/formats/text.h"

namespace tessera {
namespace {

struct Line {
  Rgb colour;
  int count = 0;
  double area = 0;
};

// A CSV field; quoted where it needs to be.
void append_field(std::string& out, const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) {
    out += text;
    return;
  }
  out += '"';
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  out += '"';
}

}  // namespace

std::string write_bill_csv(const PieceSheet& sheet) {
  std::map<std::tuple<int, int, int>, Line> by_colour;
  double whole = 0;
  for (const Piece& piece : sheet.pieces) {
    Line& line = by_colour[{piece.fill.r, piece.fill.g, piece.fill.b}];
    line.colour = piece.fill;
    ++line.count;
    line.area += area(piece.outline);
    whole += area(piece.outline);
  }
  std::vector<Line> lines;
  for (const auto& [key, line] : by_colour) lines.push_back(line);
  std::stable_sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) { return a.area > b.area; });
  const double mm = sheet.width_mm > 0 ? sheet.width_mm / sheet.width : 0;
  std::string out = "colour,name,count,area_px2,area_mm2,share\n";
  for (const Line& line : lines) {
    append_colour(out, line.colour);
    out += ',';
    const auto named = std::find_if(sheet.materials.begin(), sheet.materials.end(),
                                    [&](const Material& m) { return m.colour == line.colour; });
    if (named != sheet.materials.end()) append_field(out, named->name);
    out += ',';
    append_integer(out, line.count);
    out += ',';
    append_number(out, line.area);
    out += ',';
    if (mm > 0) append_number(out, line.area * mm * mm);
    out += ',';
    append_number(out, whole > 0 ? line.area / whole : 0);
    out += '\n';
  }
  return out;
}

}  // namespace tessera
