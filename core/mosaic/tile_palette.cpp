#include "tessera/mosaic/tile_palette.h"

#include "tessera/base/text.h"

namespace tessera::mosaic {
namespace {

constexpr std::size_t kMostColours = 1024;

// "warm chalk #f4f1e8": the last word is the colour.
bool parse_entry(std::string_view entry, Material& material) {
  const auto words = split(entry, " \t");
  if (words.empty() || !parse_colour(words.back(), material.colour)) return false;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    if (i > 0) material.name += ' ';
    material.name += words[i];
  }
  return true;
}

}  // namespace

bool parse_palette(const std::string& text, TilePalette& palette) {
  palette = {};
  const auto entries = split(text, ",;\n\r");
  if (entries.size() > kMostColours) return false;
  double number = 0;
  if (entries.size() == 1 && entries[0].size() <= 3 && parse_number(entries[0], number)) {
    palette.count = static_cast<int>(number);
    return palette.count == number && number >= 2 && number <= 256;
  }
  for (const std::string_view entry : entries) {
    if (split(entry, " \t").empty()) continue;
    Material material;
    if (!parse_entry(entry, material)) return false;
    palette.materials.push_back(std::move(material));
  }
  return true;
}

}  // namespace tessera::mosaic
