#include "tessera/formats/text.h"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstring>
#include <iterator>

namespace tessera {
namespace {

// Three digits at a time, from a table: a sheet of a million pieces has eight million numbers.
struct Triple {
  char digits[3];
  std::uint8_t decimals;  // digits that are left without trailing zeros
};

constexpr std::array<Triple, 1000> kTriples = [] {
  std::array<Triple, 1000> triples{};
  for (int i = 0; i < 1000; ++i) {
    const auto digit = [i](int power) { return static_cast<char>('0' + i / power % 10); };
    const int decimals = i % 10 != 0 ? 3 : i % 100 != 0 ? 2 : i != 0 ? 1 : 0;
    triples[static_cast<std::size_t>(i)] = {{digit(100), digit(10), digit(1)}, static_cast<std::uint8_t>(decimals)};
  }
  return triples;
}();

}  // namespace

void append_number(std::string& out, double value) {
  assert(std::isfinite(value));
  if (std::abs(value) >= 1e15) {  // which has no thousandths: the area, mm2, of a kilometre of pixels
    fmt::format_to(std::back_inserter(out), "{:.0f}", value);
    return;
  }
  const double shifted = std::abs(value) * 1000 + 0.5;  // cut off below, which rounds
  const auto thousandths = static_cast<std::uint64_t>(shifted);
  std::uint64_t whole = thousandths / 1000;
  const Triple& fraction = kTriples[thousandths % 1000];
  char buffer[32];
  char* const point = buffer + 24;
  *point = '.';
  std::memcpy(point + 1, fraction.digits, 3);
  char* start = point;
  for (; whole >= 1000; whole /= 1000) std::memcpy(start -= 3, kTriples[whole % 1000].digits, 3);
  const int leading = whole < 10 ? 1 : whole < 100 ? 2 : 3;
  std::memcpy(start - 3, kTriples[whole].digits, 3);
  start -= leading;
  if (value < 0 && thousandths != 0) *--start = '-';
  const char* const end = fraction.decimals > 0 ? point + 1 + fraction.decimals : point;
  out.append(start, static_cast<std::size_t>(end - start));
}

void append_integer(std::string& out, std::int64_t value) {
  char buffer[24];
  out.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

void append_colour(std::string& out, Rgb colour) {
  constexpr char kHex[] = "0123456789abcdef";
  const char text[7] = {'#',
                        kHex[colour.r >> 4],
                        kHex[colour.r & 15],
                        kHex[colour.g >> 4],
                        kHex[colour.g & 15],
                        kHex[colour.b >> 4],
                        kHex[colour.b & 15]};
  out.append(text, sizeof text);
}

void append_point(std::string& out, Point p, char separator) {
  append_number(out, p.x);
  out += separator;
  append_number(out, p.y);
}

void append_piece_id(std::string& out, const PieceSheet& sheet, const Piece& piece) {
  out += sheet.kind;
  out += '-';
  append_integer(out, piece.id);
}

void append_xml(std::string& out, std::string_view text) {
  constexpr std::string_view kReplacement = "\xEF\xBF\xBD";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const std::string_view three = text.substr(i, 3);
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (three == "\xEF\xBF\xBE" || three == "\xEF\xBF\xBF") {  // U+FFFE, U+FFFF
      out += kReplacement;
      i += 2;
    } else if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' && c != '\r') {
      out += kReplacement;
    } else {
      out += c;
    }
  }
}

std::size_t room_for(const PieceSheet& sheet, std::size_t per_piece, std::size_t per_vertex) {
  std::size_t vertices = 0;
  for (const Piece& piece : sheet.pieces) {
    vertices += piece.outline.outer.size();
    for (const Ring& hole : piece.outline.holes) vertices += hole.size();
  }
  return sheet.pieces.size() * per_piece + vertices * per_vertex;
}

}  // namespace tessera
