#include "tessera/job/shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tessera/base/portable_math.h"

namespace tessera {
namespace {

using ::testing::HasSubstr;

constexpr std::uint64_t kMost = 100'000'000;

std::string svg(const std::string& inside) {
  return "<?xml version='1.0'?><svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 300 200'>" + inside + "</svg>";
}

// The number at a place of the viewBox, -1 where the file is refused.
int at(const std::string& inside, double x, double y) {
  const auto raster = read_shapes(svg(inside), kMost);
  if (!raster) return -1;
  const auto column = static_cast<std::size_t>(x * 10), row = static_cast<std::size_t>(y * 10);
  const std::uint8_t* pixel = raster->bytes.data() + 3 * (row * static_cast<std::size_t>(raster->width) + column);
  return pixel[0] << 16 | pixel[1] << 8 | pixel[2];
}

// In units of the viewBox.
double area_of(const std::string& inside, int number = 1) {
  const auto raster = read_shapes(svg(inside), kMost);
  if (!raster) return -1;
  double count = 0;
  for (std::size_t i = 0; i < raster->bytes.size(); i += 3) count += raster->bytes[i + 2] == number;
  return count / 100;
}

TEST(Shapes, AreasOfClosedForms) {
  EXPECT_NEAR(area_of("<rect x='10' y='20' width='50' height='40'/>"), 2000, 1);
  EXPECT_NEAR(area_of("<circle cx='100' cy='100' r='50'/>"), kPi * 2500, 8);
  EXPECT_NEAR(area_of("<ellipse cx='100' cy='100' rx='50' ry='20'/>"), kPi * 1000, 4);
  EXPECT_NEAR(area_of("<polygon points='10,10 110,10 10,110'/>"), 5000, 10);
  EXPECT_NEAR(area_of("<path d='M10 10h100v50h-100z'/>"), 5000, 1);
  EXPECT_NEAR(area_of("<path d='M50,100a50 50 0 1 0 100 0A50 50 0 0 0 50 100'/>"), kPi * 2500, 8);
  EXPECT_NEAR(area_of("<path d='M50,100a50 50 0 01100 0z'/>"), kPi * 1250, 8);
  // Below a parabola: two thirds of its box; the cubic of the same control points, three fifths of twice 25.
  EXPECT_NEAR(area_of("<path d='M0 100Q50 0 100 100Z'/>"), 2.0 / 3 * 100 * 50, 5);
  EXPECT_NEAR(area_of("<path d='M0 100C0 50 100 50 100 100Z'/>"), 0.6 * 100 * 50, 5);
  EXPECT_NEAR(area_of("<path d='M0 50q25-50 50 0t50 0v50H0z'/>"), 5000, 5);
  EXPECT_NEAR(area_of("<path d='M10 10 110 10 110 110 10 110ZM30 30H60V60H30Z'/>"), 10000 - 900, 2);
  EXPECT_NEAR(area_of("<path d='M.5.5 100.5.5l0,1e2-100 0z'/>"), 10000, 5);
}

TEST(Shapes, LaterOnesLieAbove) {
  const std::string two = "<rect width='100' height='100'/><g><rect x='50' width='100' height='100'/></g>";
  EXPECT_EQ(at(two, 10, 10), 1);
  EXPECT_EQ(at(two, 60, 10), 2);
  EXPECT_EQ(at(two, 160, 10), 0);
}

TEST(Shapes, TransformsAreApplied) {
  const std::string unit = "<rect width='10' height='10'/>";
  const auto in = [&](const char* transform) {
    return "<g transform='" + std::string(transform) + "'>" + unit + "</g>";
  };
  EXPECT_EQ(at(in("translate(100 50)"), 105, 55), 1);
  EXPECT_EQ(at(in("translate(100 50) scale(2)"), 119, 69), 1);
  EXPECT_EQ(at(in("rotate(45 100 100) translate(100,100)"), 100, 112), 1);
  EXPECT_EQ(at(in("matrix(1 0 0 1 7 90)"), 16, 99), 1);
  EXPECT_EQ(at(in("translate(100 50)"), 5, 5), 0);
  EXPECT_EQ(at(in("perspective(3)"), 5, 5), -1);
}

TEST(Shapes, WhatIsNotDisplayedIsLeftOut) {
  const std::string shown = "<rect x='200' width='10' height='10'/>";
  for (const char* hidden :
       {"<defs><path d='M0 0h100v100z'/></defs>", "<g display='none'><rect width='9' height='9'/></g>",
        "<clipPath id='a'><rect width='9' height='9'/></clipPath>", "<!-- <rect width='9' height='9'/> -->"}) {
    EXPECT_EQ(at(hidden + shown, 1, 1), 0) << hidden;
    EXPECT_EQ(at(hidden + shown, 205, 5), 1) << hidden;
  }
}

TEST(Shapes, HostileFilesAreRefused) {
  const auto message = [](const std::string& text, std::uint64_t most = kMost) {
    const auto raster = read_shapes(text, most);
    return raster ? std::string("fine") : raster.error().message;
  };
  EXPECT_THAT(message(""), HasSubstr("no closed shape"));
  EXPECT_THAT(message("<html></html>"), HasSubstr("no SVG"));
  EXPECT_THAT(message("<svg viewBox='0 0 9 9'>"), HasSubstr("well-formed"));
  EXPECT_THAT(message("<!DOCTYPE svg [<!ENTITY a 'b'>]><svg viewBox='0 0 9 9'></svg>"), HasSubstr("well-formed"));
  EXPECT_THAT(message("<svg viewBox='0 0 0 9'><rect width='1' height='1'/></svg>"), HasSubstr("no size"));
  EXPECT_THAT(message("<svg viewBox='0 0 nan 9'></svg>"), HasSubstr("viewBox"));
  EXPECT_THAT(message("<svg><rect width='1' height='1'/></svg>"), HasSubstr("no size"));
  EXPECT_THAT(message(svg("<text>a</text>")), HasSubstr("no closed shape"));
  EXPECT_THAT(message(svg("<rect width='0' height='1'/>")), HasSubstr("shape 1, a rect"));
  EXPECT_THAT(message(svg("<path d='M0 0L10 0L10 10'/>")), HasSubstr("open"));
  EXPECT_THAT(message(svg("<path d='M0 0L10 0L10 1e400Z'/>")), HasSubstr("cannot be read"));
  EXPECT_THAT(message(svg("<path d='M0 0L10 NaN Z'/>")), HasSubstr("cannot be read"));
  EXPECT_THAT(message(svg("<path d='L10 0 10 10Z'/>")), HasSubstr("cannot be read"));
  EXPECT_THAT(message(svg("<path d='M0 0 10 0 10 10Z 5 5'/>")), HasSubstr("cannot be read"));
  EXPECT_THAT(message(svg("<path/>")), HasSubstr("cannot be read"));
  EXPECT_THAT(message(svg("<rect width='9' height='9'/>"), 1000), HasSubstr("3000 x 2000"));
  EXPECT_THAT(message(svg("<rect width='9' height='9'/>"), 1000), HasSubstr("(--max-pixels)"));
  EXPECT_THAT(message(svg("<rect width='9' height='9'/></g>")), HasSubstr("well-formed"));
}

// Numbers that are finite each by themselves.
TEST(Shapes, NothingLeadsToInfinity) {
  std::string far;
  for (int i = 0; i < 60; ++i) far += "matrix(1e6 0 0 1e6 1 1)";
  const auto raster = read_shapes(svg("<path transform='" + far + "' d='M0 0h1v1z'/>"), kMost);
  ASSERT_FALSE(raster.has_value());
  EXPECT_THAT(raster.error().message, HasSubstr("too far"));
  for (const std::string shape :
       {"<path d='M0 1e6h9v9z'/>", "<path d='M0 -1e6h9v9z'/>", "<path transform='scale(1e6 1e6)' d='M1 1h9v9z'/>",
        "<path d='M0 0A9 9 0 0 0 1e-200 1e-200z'/>", "<path d='M0 0a1e6 1e6 0 1 1 1e-9 0z'/>"})
    EXPECT_LE(area_of(shape), 0) << shape;  // -1: a line is no area
}

TEST(Shapes, AnyTextIsReadWithoutHarm) {
  const std::string good =
      svg("<g transform='rotate(3)'><path d='M1 1c2-3 4 5 60 70a5 5 0 1 1 9 9zm5 5h20v20z'/></g>");
  for (std::size_t cut = 0; cut < good.size(); ++cut) {
    (void)read_shapes(good.substr(0, cut), kMost / 1000);
    std::string other = good;
    other[cut] = static_cast<char>("<>'\"=-.e0zA /"[cut % 13]);
    (void)read_shapes(other, kMost / 1000);
  }
}

TEST(Shapes, AreToldFromPictures) {
  EXPECT_TRUE(looks_like_svg("\n<?xml version='1.0'?>\n<svg/>"));
  EXPECT_TRUE(looks_like_svg("\xef\xbb\xbf<svg viewBox=''/>"));
  EXPECT_FALSE(looks_like_svg("\x89PNG<svg"));
  EXPECT_FALSE(looks_like_svg("<html>"));
  EXPECT_FALSE(looks_like_svg(""));
}

}  // namespace
}  // namespace tessera
