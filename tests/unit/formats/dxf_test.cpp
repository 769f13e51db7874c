#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "sheets.h"
#include "tessera/formats/formats.h"

namespace tessera {
namespace {

struct Tag {
  int code;
  std::string value;
};

std::vector<Tag> tags_of(const std::string& dxf) {
  std::vector<Tag> tags;
  std::istringstream lines(dxf);
  for (std::string code, value; std::getline(lines, code) && std::getline(lines, value);)
    tags.push_back({std::stoi(code), value});
  return tags;
}

struct Polyline {
  std::string layer;
  Ring ring;
  std::size_t announced = 0;
  bool closed = false;
};

std::vector<Polyline> polylines_of(const std::vector<Tag>& tags) {
  std::vector<Polyline> found;
  bool inside = false;
  for (const Tag& tag : tags) {
    if (tag.code == 0) {
      inside = tag.value == "LWPOLYLINE";
      if (inside) found.emplace_back();
    }
    if (!inside) continue;
    switch (tag.code) {
      case 8: found.back().layer = tag.value; break;
      case 90: found.back().announced = std::stoul(tag.value); break;
      case 70: found.back().closed = tag.value == "1"; break;
      case 10: found.back().ring.push_back({std::stod(tag.value), 0}); break;
      case 20: found.back().ring.back().y = std::stod(tag.value); break;
      default: break;
    }
  }
  return found;
}

std::map<std::string, int> layers_of(const std::vector<Tag>& tags) {
  std::map<std::string, int> layers;
  std::string name;
  bool inside = false;
  for (const Tag& tag : tags) {
    if (tag.code == 0) inside = tag.value == "LAYER";
    if (inside && tag.code == 2) name = tag.value;
    if (inside && tag.code == 62) layers[name] = std::stoi(tag.value);
  }
  return layers;
}

// The tags after (9, name).
std::vector<Tag> variable(const std::vector<Tag>& tags, const std::string& name) {
  std::vector<Tag> values;
  bool inside = false;
  for (const Tag& tag : tags) {
    if (tag.code == 9 || tag.code == 0)
      inside = tag.value == name;
    else if (inside)
      values.push_back(tag);
  }
  return values;
}

TEST(WriteDxf, HeaderSaysVersionUnitsAndExtents) {
  PieceSheet sheet = two_stones();
  sheet.width_mm = 500;
  const auto tags = tags_of(write_dxf(sheet));
  EXPECT_EQ(variable(tags, "$ACADVER").at(0).value, "AC1015");
  EXPECT_EQ(variable(tags, "$INSUNITS").at(0).value, "4");
  EXPECT_EQ(variable(tags, "$EXTMAX").at(0).value, "500");
  EXPECT_EQ(variable(tags, "$EXTMAX").at(1).value, "250");
  EXPECT_EQ(tags.back().value, "EOF");
}

TEST(WriteDxf, RingsAreInMillimetresWithYUp) {
  PieceSheet sheet = two_stones();
  sheet.width_mm = 200;  // 10 mm a pixel
  const auto polylines = polylines_of(tags_of(write_dxf(sheet)));
  ASSERT_EQ(polylines.size(), 3U);
  EXPECT_EQ(polylines[0].ring, (Ring{{5, 97.5}, {90, 97.5}, {90, 10}, {5, 10}}));
  EXPECT_EQ(polylines[2].ring, (Ring{{120, 70}, {120, 50}, {150, 50}, {150, 70}}));
  EXPECT_EQ(polylines[0].layer, "stones-000000");
  EXPECT_EQ(polylines[1].layer, "stones-fffa0a");
  EXPECT_EQ(polylines[2].layer, "stones-fffa0a");
  for (const Polyline& p : polylines) {
    EXPECT_TRUE(p.closed);
    EXPECT_EQ(p.announced, p.ring.size());
  }
}

TEST(WriteDxf, PixelsAreMillimetresWithoutAWidth) {
  EXPECT_EQ(polylines_of(tags_of(write_dxf(two_stones()))).at(0).ring,
            (Ring{{0.5, 9.75}, {9, 9.75}, {9, 1}, {0.5, 1}}));
}

TEST(WriteDxf, LayersHaveTheNearestIndexedColour) {
  const std::vector<std::pair<Rgb, int>> cases = {{{255, 0, 0}, 1},     {{255, 255, 0}, 2}, {{0, 255, 0}, 3},
                                                  {{0, 255, 255}, 4},   {{0, 0, 255}, 5},   {{255, 0, 255}, 6},
                                                  {{130, 127, 128}, 8}, {{0, 0, 0}, 250},   {{255, 255, 255}, 255},
                                                  {{255, 127, 0}, 30},  {{0, 76, 0}, 96},   {{255, 127, 127}, 11}};
  PieceSheet sheet = two_stones();
  const Piece piece = sheet.pieces[0];
  sheet.pieces.clear();
  for (const auto& [colour, index] : cases) {
    sheet.pieces.push_back(piece);
    sheet.pieces.back().fill = colour;
  }
  const std::string dxf = write_dxf(sheet);
  const auto tags = tags_of(dxf);
  const auto layers = layers_of(tags);
  const auto polylines = polylines_of(tags);
  EXPECT_EQ(layers.size(), cases.size() + 1);  // and layer 0
  ASSERT_EQ(polylines.size(), cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i) EXPECT_EQ(layers.at(polylines[i].layer), cases[i].second) << i;
}

TEST(WriteDxf, ManyColoursAreMergedIntoThoseOfTheIndex) {
  const PieceSheet sheet = random_sheet(1, 40);
  const auto tags = tags_of(write_dxf(sheet));
  const auto layers = layers_of(tags);
  EXPECT_LE(layers.size(), 256U);
  EXPECT_GT(layers.size(), 50U);
  for (const Polyline& p : polylines_of(tags)) EXPECT_EQ(layers.count(p.layer), 1U);
}

TEST(WriteDxf, HandlesAreUniqueAndBelowTheSeed) {
  for (const PieceSheet& sheet : {two_stones(), random_sheet(1, 5), random_sheet(2, 30)}) {
    const auto tags = tags_of(write_dxf(sheet));
    const std::string seed = variable(tags, "$HANDSEED").at(0).value;
    std::set<unsigned long> handles, references;
    for (const Tag& tag : tags) {
      const bool own = (tag.code == 5 && tag.value != seed) || tag.code == 105;
      if (own) {
        EXPECT_TRUE(handles.insert(std::stoul(tag.value, nullptr, 16)).second) << tag.value;
      }
      if (tag.code == 330 || tag.code == 340 || tag.code == 350 || tag.code == 390)
        references.insert(std::stoul(tag.value, nullptr, 16));
    }
    EXPECT_LT(*handles.rbegin(), std::stoul(seed, nullptr, 16));
    references.erase(0);  // none
    for (const unsigned long reference : references) EXPECT_EQ(handles.count(reference), 1U) << reference;
  }
}

}  // namespace
}  // namespace tessera
