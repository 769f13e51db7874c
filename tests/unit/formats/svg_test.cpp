#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "sheets.h"
#include "tessera/formats/formats.h"

namespace tessera {
namespace {

constexpr const char* kTwoStones = R"(<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" version="1.1" width="20px" height="10px" viewBox="0 0 20 10">
<g id="grout" inkscape:groupmode="layer" inkscape:label="grout">
<rect x="0" y="0" width="20" height="10" fill="#0102ff"/>
</g>
<g id="stones" inkscape:groupmode="layer" inkscape:label="stones">
<path id="stone-1" class="stone" fill="#000000" d="M0.5 0.25L9 0.25L9 9L0.5 9Z"/>
<path id="stone-17" class="stone" fill="#fffa0a" fill-rule="evenodd" d="M10 1L18 1L18 9L10 9ZM12 3L12 5L15 5L15 3Z"/>
</g>
</svg>
)";

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t start = text.find(begin) + begin.size();
  return text.substr(start, text.find(end, start) - start);
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

std::string metadata(const std::string& svg) {
  std::string text = between(svg, "<metadata>", "</metadata>");
  EXPECT_EQ(text.find('<'), std::string::npos);
  for (const auto& [entity, character] : {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}})
    replace_all(text, entity, character);
  return text;
}

TEST(WriteSvg, ExactText) { EXPECT_EQ(write_svg(two_stones()), kTwoStones); }

TEST(WriteSvg, EmptySheet) {
  PieceSheet sheet = two_stones();
  sheet.pieces.clear();
  const std::string svg = write_svg(sheet);
  EXPECT_NE(svg.find("<g id=\"stones\""), std::string::npos);
  EXPECT_EQ(svg.find("<path"), std::string::npos);
}

TEST(WriteSvg, MillimetresKeepTheViewBoxInPixels) {
  PieceSheet sheet = two_stones();
  sheet.width_mm = 1500;
  const std::string svg = write_svg(sheet);
  EXPECT_NE(svg.find("width=\"1500mm\" height=\"750mm\" viewBox=\"0 0 20 10\""), std::string::npos);
  EXPECT_EQ(svg.substr(svg.find("<g id=")), std::string(kTwoStones).substr(std::string(kTwoStones).find("<g id=")));
}

TEST(WriteSvg, HostileJobComesBackFromTheMetadata) {
  const nlohmann::json job = {
      {"technique", "pave"},
      {"inputs", {{"drawing", "a</metadata><script>&lt;&amp; ]]> \"quoted\" 'x' cal\u00e7ada\n"}}},
      {"params", {{"halfSide", 4.5}}}};
  for (const int indent : {-1, 2}) {
    PieceSheet sheet = two_stones();
    sheet.job_json = job.dump(indent);
    const std::string svg = write_svg(sheet);
    EXPECT_EQ(nlohmann::json::parse(metadata(svg)), job);
    EXPECT_EQ(svg.find("<script"), std::string::npos);
    EXPECT_EQ(svg.find("]]>"), std::string::npos);
  }
}

TEST(WriteSvg, EveryPieceComesBackOverManySeeds) {
  const std::regex path(
      R"re(<path id="tile-(\d+)" class="tile" fill="(#[0-9a-f]{6})"( fill-rule="evenodd")? d="([^"]*)"/>)re");
  const std::regex vertex(R"([ML](-?\d+(?:\.\d{1,3})?) (-?\d+(?:\.\d{1,3})?))");
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const PieceSheet sheet = random_sheet(seed, 8);
    const std::string svg = write_svg(sheet);
    std::sregex_iterator at(svg.begin(), svg.end(), path);
    for (const Piece& piece : sheet.pieces) {
      ASSERT_NE(at, std::sregex_iterator());
      EXPECT_EQ(std::stoi((*at)[1]), piece.id);
      EXPECT_EQ((*at)[3].matched, !piece.outline.holes.empty());
      const std::string d = (*at)[4];
      std::vector<Point> found;
      for (std::sregex_iterator v(d.begin(), d.end(), vertex), end; v != end; ++v)
        found.push_back({std::stod((*v)[1]), std::stod((*v)[2])});
      Ring expected = piece.outline.outer;
      for (const Ring& hole : piece.outline.holes) expected.insert(expected.end(), hole.begin(), hole.end());
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t i = 0; i < found.size(); ++i) EXPECT_LE(length(found[i] - expected[i]), 0.00071);
      EXPECT_EQ(static_cast<std::size_t>(std::count(d.begin(), d.end(), 'Z')), 1 + piece.outline.holes.size());
      EXPECT_EQ(d.back(), 'Z');
      ++at;
    }
    EXPECT_EQ(at, std::sregex_iterator());
  }
}

}  // namespace
}  // namespace tessera
