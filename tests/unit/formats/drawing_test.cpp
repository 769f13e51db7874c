// Drawings in mm as SVG and DXF.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tessera/formats/formats.h"

namespace tessera {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Drawing sample() {
  Drawing drawing;
  drawing.left = 5, drawing.top = -2, drawing.width = 100, drawing.height = 60.5;
  drawing.layers = {
      {"engrave", {0, 0, 255}, 0.01, {{"label-A1", {{{10, 10}, {12, 11}}, {{12, 10}, {10, 11}}}, false}}},
      {"cut", {255, 0, 0}, 0.01, {{"cut-A1", {{{8, 8}, {20, 8}, {20, 20}, {8, 20}}}, true}}}};
  drawing.job_json = R"({"a":"<&>"})";
  return drawing;
}

TEST(DrawingSvg, IsInMillimetresWithLayers) {
  const std::string svg = write_svg(sample());
  EXPECT_THAT(svg, HasSubstr(R"(width="100mm" height="60.5mm" viewBox="5 -2 100 60.5")"));
  EXPECT_THAT(svg, HasSubstr("<metadata>{\"a\":\"&lt;&amp;&gt;\"}</metadata>"));
  EXPECT_THAT(
      svg,
      HasSubstr(
          R"(<g id="cut" inkscape:groupmode="layer" inkscape:label="cut" fill="none" stroke="#ff0000" stroke-width="0.01">)"));
  EXPECT_THAT(svg, HasSubstr(R"(<path id="cut-A1" d="M8 8L20 8L20 20L8 20Z"/>)"));
  EXPECT_THAT(svg, HasSubstr(R"(<path id="label-A1" d="M10 10L12 11M12 10L10 11"/>)"));
  EXPECT_LT(svg.find("label-A1"), svg.find("cut-A1"));
  EXPECT_THAT(svg, Not(HasSubstr("inkscape:page")));
}

TEST(DrawingSvg, NamesItsPages) {
  Drawing drawing = sample();
  drawing.pages = {{0, 0, 50, 60}, {50, 0, 50, 60}};
  EXPECT_THAT(write_svg(drawing), HasSubstr(R"(<inkscape:page x="50" y="0" width="50" height="60"/>)"));
}

TEST(DrawingDxf, TurnsYOverWithinItsFrame) {
  const std::string dxf = write_dxf(sample());
  EXPECT_THAT(dxf, HasSubstr("$EXTMIN\n10\n5\n20\n-2\n"));
  EXPECT_THAT(dxf, HasSubstr("$EXTMAX\n10\n105\n20\n58.5\n"));
  // (8, 8) is 10 below the upper side, which is at 58.5 now.
  EXPECT_THAT(dxf, HasSubstr("8\ncut\n100\nAcDbPolyline\n90\n4\n70\n1\n10\n8\n20\n48.5\n"));
  EXPECT_THAT(dxf, HasSubstr("8\nengrave\n100\nAcDbPolyline\n90\n2\n70\n0\n"));
}

}  // namespace
}  // namespace tessera
