#include <gtest/gtest.h>
#include <lodepng.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "animation.h"
#include "sheets.h"
#include "tessera/formats/coverage.h"
#include "tessera/formats/formats.h"

namespace tessera {
namespace {

struct Picture {
  unsigned width = 0, height = 0;
  std::vector<unsigned char> rgb;

  Rgb at(unsigned x, unsigned y) const {
    const unsigned char* p = &rgb[3 * (y * width + x)];
    return {p[0], p[1], p[2]};
  }
};

// Another library reads what ours wrote.
Picture decoded(const std::string& png) {
  Picture picture;
  EXPECT_EQ(lodepng::decode(picture.rgb, picture.width, picture.height,
                            reinterpret_cast<const unsigned char*>(png.data()), png.size(), LCT_RGB, 8),
            0U);
  return picture;
}

PieceSheet sheet_of(double width, double height, const std::vector<Piece>& pieces) {
  PieceSheet sheet;
  sheet.width = width;
  sheet.height = height;
  sheet.grout = {100, 100, 100};
  sheet.pieces = pieces;
  return sheet;
}

Ring box(double left, double top, double right, double bottom) {
  return {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
}

double covered_area(const Polygon& polygon, double scale, int width, int height) {
  Coverage coverage(width, height);
  double sum = 0;
  coverage.each_pixel(polygon, scale, [&](int x, int y, float share) {
    EXPECT_TRUE(x >= 0 && x < width && y >= 0 && y < height);
    EXPECT_TRUE(share > 0 && share <= 1);
    sum += share;
  });
  return sum;
}

TEST(Coverage, SumsUpToTheAreaOverManySeeds) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const PieceSheet sheet = random_sheet(seed, 3);
    for (const Piece& piece : sheet.pieces)
      for (const double scale : {0.13, 1.0, 3.7})
        EXPECT_NEAR(covered_area(piece.outline, scale, 120, 120), area(piece.outline) * scale * scale,
                    2e-4 * (10 + 100 * scale * scale));
  }
}

TEST(Coverage, OneWholePixelAndPartsOfOne) {
  EXPECT_FLOAT_EQ(static_cast<float>(covered_area({box(3, 4, 4, 5), {}}, 1, 8, 8)), 1);
  EXPECT_NEAR(covered_area({box(3.25, 4.5, 3.75, 4.75), {}}, 1, 8, 8), 0.125, 1e-6);
  EXPECT_NEAR(covered_area({{{3, 4}, {4, 4}, {3, 5}}, {}}, 1, 8, 8), 0.5, 1e-6);
}

TEST(Coverage, WhatLeavesThePictureIsCutOff) {
  EXPECT_NEAR(covered_area({box(-5, -5, 3, 2), {}}, 1, 8, 8), 6, 1e-5);
  EXPECT_NEAR(covered_area({box(-1e9, -1e9, 1e9, 1e9), {}}, 1, 8, 8), 64, 1e-5);
  EXPECT_NEAR(covered_area({{{4, -4}, {12, 4}, {4, 12}, {-4, 4}}, {}}, 1, 8, 8), 64, 1e-5);
  EXPECT_NEAR(covered_area({{{4, -2}, {10, 4}, {4, 10}, {-2, 4}}, {}}, 1, 8, 8), 56, 1e-5);
  EXPECT_EQ(covered_area({box(9, 9, 12, 12), {}}, 1, 8, 8), 0);
  EXPECT_EQ(covered_area({box(-9, 2, -1, 6), {}}, 1, 8, 8), 0);
}

TEST(Coverage, HolesAreCutOffToo) {
  const Polygon frame{box(1, 1, 7, 7), {box(2, 2, 5, 4.5)}};
  EXPECT_NEAR(covered_area(frame, 1, 8, 8), 36 - 7.5, 1e-5);
  EXPECT_NEAR(covered_area({box(-20, -20, 20, 20), {box(-10, -10, 4, 20)}}, 1, 8, 8), 32, 1e-5);
  EXPECT_NEAR(covered_area({box(1, 1, 7, 7), {box(-3, -3, 30, 2)}}, 1, 8, 8), 30, 1e-5);  // a hole that leaves it
}

TEST(WritePng, ColoursInsideOutsideAndInHoles) {
  const Picture picture = decoded(write_png(two_stones()));
  ASSERT_EQ(picture.width, 20U);
  ASSERT_EQ(picture.height, 10U);
  EXPECT_EQ(picture.at(4, 4), (Rgb{0, 0, 0}));
  EXPECT_EQ(picture.at(11, 2), (Rgb{255, 250, 10}));
  EXPECT_EQ(picture.at(13, 4), (Rgb{1, 2, 255}));
  EXPECT_EQ(picture.at(19, 9), (Rgb{1, 2, 255}));
  EXPECT_EQ(picture.at(0, 5), (Rgb{1, 1, 128}));  // half covered by black
}

TEST(WritePng, ScaleIsPixelsAPixel) {
  const Picture twice = decoded(write_png(two_stones(), 2)), half = decoded(write_png(two_stones(), 0.5));
  EXPECT_EQ(twice.width, 40U);
  EXPECT_EQ(twice.height, 20U);
  EXPECT_EQ(twice.at(27, 8), (Rgb{1, 2, 255}));
  EXPECT_EQ(twice.at(30, 8), (Rgb{255, 250, 10}));
  EXPECT_EQ(half.width, 10U);
  EXPECT_EQ(half.height, 5U);
  const Picture least = decoded(write_png(two_stones(), 1e-6));
  EXPECT_EQ(least.width * least.height, 1U);
}

TEST(WritePng, NoGroutShinesThroughWherePiecesJoin) {
  PieceSheet sheet = sheet_of(9, 9, {});
  const Point middle{4.3, 4.7};
  const Ring border = {{0, 0}, {5, 0}, {9, 0}, {9, 6}, {9, 9}, {2, 9}, {0, 9}, {0, 3}};
  for (std::size_t i = 0; i < border.size(); ++i) {
    const Ring wedge = {middle, border[i], border[(i + 1) % border.size()]};
    sheet.pieces.push_back({static_cast<int>(i), {wedge, {}}, {240, 30, 240}});
  }
  const Picture picture = decoded(write_png(sheet));
  for (unsigned y = 0; y < 9; ++y)
    for (unsigned x = 0; x < 9; ++x) {
      const Rgb c = picture.at(x, y);
      EXPECT_LE(std::abs(c.r - 240) + std::abs(c.g - 30) + std::abs(c.b - 240), 12) << x << ' ' << y;
    }
}

TEST(WritePng, TheLaterOfTwoThatOverlapLiesOnTop) {
  const Picture picture = decoded(write_png(sheet_of(8, 4,
                                                     {{1, {box(0, 0, 5, 4), {}}, {250, 0, 0}},
                                                      {2, {box(3, 0, 8, 4), {}}, {0, 0, 250}},
                                                      {3, {box(6.5, 0, 7, 4), {}}, {0, 200, 0}}})));
  EXPECT_EQ(picture.at(1, 1), (Rgb{250, 0, 0}));
  EXPECT_EQ(picture.at(4, 1), (Rgb{0, 0, 250}));
  EXPECT_EQ(picture.at(6, 1), (Rgb{0, 100, 125}));
}

TEST(WritePng, OnASeamlessSheetWhatSticksOutComesInAgain) {
  PieceSheet sheet = sheet_of(10, 8, {{1, {box(8, 6, 12, 9), {box(9, 7, 11, 7.5)}}, {255, 0, 0}}});
  EXPECT_EQ(decoded(write_png(sheet)).at(0, 6), (Rgb{100, 100, 100}));
  sheet.seamless = true;
  const Picture picture = decoded(write_png(sheet));
  for (const auto& [x, y] : {std::pair{8U, 6U}, {9U, 6U}, {0U, 6U}, {1U, 6U}, {8U, 0U}, {1U, 0U}, {0U, 0U}})
    EXPECT_EQ(picture.at(x, y), (Rgb{255, 0, 0})) << x << ", " << y;
  for (const auto& [x, y] : {std::pair{2U, 6U}, {7U, 6U}, {0U, 5U}, {0U, 1U}, {2U, 0U}, {8U, 1U}})
    EXPECT_EQ(picture.at(x, y), (Rgb{100, 100, 100})) << x << ", " << y;
  EXPECT_EQ(picture.at(0, 7), picture.at(9, 7));  // halves of the hole
}

TEST(WritePng, MeanColourIsThatOfTheAreasOverManySeeds) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const PieceSheet sheet = random_sheet(seed, 6);
    const Picture picture = decoded(write_png(sheet, 1.7));
    double expected = sheet.grout.g * sheet.width * sheet.height, found = 0;
    for (const Piece& piece : sheet.pieces) expected += area(piece.outline) * (piece.fill.g - sheet.grout.g);
    for (unsigned y = 0; y < picture.height; ++y)
      for (unsigned x = 0; x < picture.width; ++x) found += picture.at(x, y).g;
    EXPECT_NEAR(found / (picture.width * picture.height), expected / (sheet.width * sheet.height), 0.5);
  }
}

TEST(WritePng, LargeNoisyPictureTakesSeveralChunks) {
  PieceSheet sheet = random_sheet(7, 64);
  const std::string png = write_png(sheet, 1.3);
  EXPECT_GT(png.size(), std::size_t{1} << 18);
  const Picture picture = decoded(png);
  EXPECT_EQ(picture.width, 832U);
  for (const Piece& piece : sheet.pieces)
    if (piece.outline.holes.empty()) {
      const Point c = 1.3 * centroid(piece.outline.outer);
      EXPECT_EQ(picture.at(static_cast<unsigned>(c.x), static_cast<unsigned>(c.y)), piece.fill);
    }
}

TEST(WritePng, ResolutionFollowsTheWidth) {
  PieceSheet sheet = two_stones();
  sheet.width_mm = 10;  // 20 px on 10 mm: 2000 px a metre
  for (const double scale : {1.0, 3.0}) {
    const std::string png = write_png(sheet, scale);
    lodepng::State state;
    std::vector<unsigned char> pixels;
    unsigned width = 0, height = 0;
    ASSERT_EQ(
        lodepng::decode(pixels, width, height, state, reinterpret_cast<const unsigned char*>(png.data()), png.size()),
        0U);
    EXPECT_EQ(state.info_png.phys_defined, 1U);
    EXPECT_EQ(state.info_png.phys_unit, 1U);
    EXPECT_EQ(state.info_png.phys_x, static_cast<unsigned>(2000 * scale));
  }
}

// A grey of 200, half of it opaque, on a ground of 100 that is nearly so; a pixel that is half covered has the mean.
TEST(WritePng, HasAsManyChannelsAsTheSheet) {
  PieceSheet sheet = sheet_of(4, 1, {{1, {box(0, 0, 1.5, 1), {}}, {200, 200, 200}, 128}});
  sheet.grout_opacity = 228;
  const struct {
    int channels;
    LodePNGColorType type;
    std::vector<unsigned char> bytes;
  } cases[] = {{1, LCT_GREY, {200, 150, 100, 100}},
               {2, LCT_GREY_ALPHA, {200, 128, 150, 178, 100, 228, 100, 228}},
               {3, LCT_RGB, {200, 200, 200, 150, 150, 150, 100, 100, 100, 100, 100, 100}},
               {4, LCT_RGBA, {200, 200, 200, 128, 150, 150, 150, 178, 100, 100, 100, 228, 100, 100, 100, 228}}};
  for (const auto& [channels, type, bytes] : cases) {
    sheet.channels = channels;
    const std::string png = write_png(sheet);
    EXPECT_TRUE(channels == 3 || static_cast<LodePNGColorType>(png[25]) == type) << channels;
    std::vector<unsigned char> pixels;
    unsigned width = 0, height = 0;
    ASSERT_EQ(lodepng::decode(pixels, width, height, reinterpret_cast<const unsigned char*>(png.data()), png.size(),
                              type, 8),
              0U);
    EXPECT_EQ(pixels, bytes) << channels;
  }
}

TEST(WriteApng, TheSheetComesFirstThenTheFrames) {
  const PieceSheet sheet = two_stones();
  std::vector<Raster> frames(3, {31, 17, 3, 8, std::vector<std::uint8_t>(std::size_t{31} * 17 * 3)});
  for (std::size_t k = 0; k < frames.size(); ++k)
    for (std::size_t i = 0; i < frames[k].bytes.size(); ++i)
      frames[k].bytes[i] = static_cast<std::uint8_t>(i * 7 + k * 40);
  const std::string file = write_apng(
      sheet, {static_cast<int>(frames.size()), [&](int k) { return frames[static_cast<std::size_t>(k)]; }});
  const Animation animation = read_animation(file);
  ASSERT_EQ(animation.frames.size(), 4u);
  EXPECT_EQ(animation.promised, 4u);
  EXPECT_EQ(animation.hundredths, (std::vector<unsigned>{200, 10, 10, 10}));
  for (std::size_t k = 0; k < frames.size(); ++k)
    EXPECT_EQ(animation.frames[k + 1], std::string(frames[k].bytes.begin(), frames[k].bytes.end())) << k;
  const Picture still = decoded(file);  // as a program sees it that knows no animation
  EXPECT_EQ(still.width, 31u);
  EXPECT_EQ(still.height, 17u);
  EXPECT_EQ(animation.frames[0], std::string(still.rgb.begin(), still.rgb.end()));
}

TEST(WriteApng, WithoutFramesItIsTheSheet) {
  const PieceSheet sheet = two_stones();
  const std::string file = write_apng(sheet, {}, 2);
  EXPECT_EQ(read_animation(file).frames.size(), 1u);
  EXPECT_EQ(decoded(file).rgb, decoded(write_png(sheet, 2)).rgb);
}

TEST(Png, a_part_of_a_picture_is_what_the_whole_has_there) {
  for (const bool seamless : {false, true}) {
    PieceSheet sheet = sheet_of(40, 30,
                                {{1, {box(2.25, 1.5, 17.75, 28.5), {box(5, 5, 9, 20)}}, {200, 20, 60}},
                                 {2, {box(20, -3, 47, 11), {}}, {10, 220, 90}},
                                 {3, {box(18.5, 14, 38.25, 33), {}}, {30, 40, 250}}});
    sheet.seamless = seamless;
    for (const double scale : {1.0, 2.5, 7.0}) {
      const Raster whole = draw_sheet(sheet, scale);
      for (const PicturePart part : {PicturePart{0, 0, whole.width, whole.height}, PicturePart{3, 5, 20, 11},
                                     PicturePart{whole.width - 13, whole.height - 9, 13, 9}}) {
        const Raster drawn = draw_sheet(sheet, scale, part);
        ASSERT_EQ(drawn.width, part.width);
        ASSERT_EQ(drawn.height, part.height);
        for (int y = 0; y < part.height; ++y)
          for (int k = 0; k < 3 * part.width; ++k) {
            const int expected = whole.bytes[3 * (part.top + y) * whole.width + 3 * part.left + k];
            ASSERT_NEAR(drawn.bytes[3 * y * part.width + k], expected, 1) << scale << " " << y << " " << k;
          }
      }
    }
  }
}

}  // namespace
}  // namespace tessera
