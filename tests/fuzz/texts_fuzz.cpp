// Small texts that people write into parameters: palettes, sizes, panels, pins, corrections, colours.
#include <vector>

#include "fuzz.h"
#include "tessera/base/text.h"
#include "tessera/mosaic/regions.h"
#include "tessera/mosaic/tile_palette.h"
#include "tessera/parquetry/panel_options.h"
#include "tessera/parquetry/pins.h"
#include "tessera/patterns/colours.h"
#include "tessera/pebbles/edits.h"

namespace tessera::fuzz {
namespace {

void try_palette(const std::string& text) {
  mosaic::TilePalette palette;
  if (!mosaic::parse_palette(text, palette)) return;
  require(palette.count == 0 || palette.materials.empty(), "a palette is a number or a list");
  require(palette.count >= 0 && palette.count <= 256 && palette.materials.size() <= 1024, "a palette is not endless");
}

void try_region_sizes(const std::string& text) {
  std::vector<mosaic::RegionSize> sizes;
  if (!mosaic::parse_region_sizes(text, sizes)) return;
  for (const auto& size : sizes) require(size.size >= 0.05 && size.size <= 20, "sizes are within their range");
}

void try_panels(const std::string& text) {
  bool complained = false;
  const auto panels = parquetry::read_panel_options(text, [&](const std::string&) { complained = true; });
  for (const auto& panel : panels) require(complained || parquetry::is_panel_name(panel.name), "panels have names");
}

void try_pins(const std::string& text) {
  for (const auto& pin : parquetry::read_pins(text)) require(pin.column >= 0 && pin.row >= 0, "vertices are counted");
}

void try_edits(const std::string& text) {
  std::vector<pebbles::Edit> edits;
  if (!pebbles::parse_edits(text, edits)) return;
  for (const auto& edit : edits) require(!edit.points.empty(), "a correction is somewhere");
  cv::Mat1i labels(12, 16, 0);
  labels(cv::Rect(1, 1, 5, 5)) = 1;
  labels(cv::Rect(8, 3, 6, 7)) = 2;
  require(pebbles::apply_edits(edits, 0.5, labels) <= static_cast<int>(edits.size()),
          "no more is done than is asked");
}

void try_colours(int channels, const std::string& text) {
  const std::string usual = "0", border = "#000";
  for (const auto& [colors, probabilities, covariance] :
       {std::array{&text, &usual, &usual}, {&border, &text, &usual}, {&border, &usual, &text}}) {
    patterns::ColourModel model;
    patterns::Levels levels{};
    if (patterns::read_colours({channels, *colors, *probabilities, *covariance, border}, model, levels).empty())
      require(!model.classes.empty(), "there is a colour");
  }
}

}  // namespace
}  // namespace tessera::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tessera::fuzz;
  const std::string text(text_of(data, size));
  try_palette(text);
  try_region_sizes(text);
  try_panels(text);
  try_pins(text);
  try_edits(text);
  for (int channels = 1; channels <= 4; ++channels) try_colours(channels, text);
  return 0;
}
