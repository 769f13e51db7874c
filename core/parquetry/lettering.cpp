#include "tessera/parquetry/lettering.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "hershey.h"
#include "tessera/base/text.h"
#include "tessera/geometry/inscribed.h"

namespace tessera::parquetry {
namespace {

constexpr double kCapital = 21;  // units of the font from a capital's foot to its head

struct Glyph {
  double left = 0, right = 0;
  std::vector<std::vector<Point>> lines;
};

// A line of James Hurt's format: a number in 5 columns, how many pairs of letters follow in 3, then these: left and
// right end, then places, each coordinate a letter away from R; " R" lifts the pen. Coordinates as ours, y down.
Glyph read_glyph(std::string_view line) {
  constexpr std::size_t kHead = 8;
  const auto unit = [&](std::size_t at) { return static_cast<double>(line[at] - 'R'); };
  Glyph glyph;
  if (line.size() < kHead + 2) return glyph;
  glyph.left = unit(kHead);
  glyph.right = unit(kHead + 1);
  bool lifted = true;
  for (std::size_t at = kHead + 2; at + 1 < line.size(); at += 2) {
    if (line.substr(at, 2) == " R") {
      lifted = true;
      continue;
    }
    if (lifted) glyph.lines.emplace_back();
    lifted = false;
    glyph.lines.back().push_back({unit(at), unit(at + 1)});
  }
  return glyph;
}

// From the blank on, in the order of ASCII.
const std::vector<Glyph>& glyphs() {
  static const std::vector<Glyph> all = [] {
    std::vector<Glyph> read;
    for (const std::string_view line : split(kHersheyFutural, "\r\n")) read.push_back(read_glyph(line));
    return read;
  }();
  return all;
}

}  // namespace

Lettering letter(std::string_view text) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Lettering lettering;
  double pen = 0;
  Point low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  for (const char c : text) {
    const auto index = static_cast<std::size_t>(c >= ' ' && c <= '~' ? c - ' ' : 0);
    if (index >= glyphs().size()) continue;
    const Glyph& glyph = glyphs()[index];
    for (const auto& line : glyph.lines) {
      auto& drawn = lettering.lines.emplace_back();
      for (const Point p : line) {
        const Point at = (1 / kCapital) * (p + Point{pen - glyph.left, 0});
        drawn.push_back(at);
        low = {std::min(low.x, at.x), std::min(low.y, at.y)};
        high = {std::max(high.x, at.x), std::max(high.y, at.y)};
      }
    }
    pen += glyph.right - glyph.left;
  }
  if (lettering.lines.empty()) return lettering;
  const Point middle = 0.5 * (low + high);
  for (auto& line : lettering.lines)
    for (Point& p : line) p -= middle;
  lettering.width = high.x - low.x;
  lettering.height = high.y - low.y;
  return lettering;
}

std::vector<std::vector<Point>> label_in(const Polygon& outline, std::string_view text, double most_height) {
  constexpr double kRoom = 0.9, kPrecision = 0.02;
  Lettering lettering = letter(text);
  if (lettering.lines.empty()) return {};
  const Circle room = largest_inscribed(outline, kPrecision);
  const double diagonal = length({lettering.width, lettering.height});
  const double size = std::min(most_height, 2 * kRoom * room.radius / diagonal);
  for (auto& line : lettering.lines)
    for (Point& p : line) p = room.centre + size * p;
  return std::move(lettering.lines);
}

}  // namespace tessera::parquetry
