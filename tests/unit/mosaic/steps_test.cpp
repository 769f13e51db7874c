// Fields, first positions, regions, palettes and colours.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "photos.h"
#include "tessera/base/portable_math.h"
#include "tessera/mosaic/colours.h"
#include "tessera/mosaic/fields.h"
#include "tessera/mosaic/regions.h"
#include "tessera/mosaic/sites.h"
#include "tessera/mosaic/tile_palette.h"

namespace tessera::mosaic {
namespace {

using testing::ElementsAre;

TEST(MosaicFields, DirectionsAreAcrossTheDiscsEdge) {
  const cv::Mat3b picture = disc_photo(200);
  const Fields fields = make_fields({view_of(picture), {}, {}, {}}, {}, 8);
  ASSERT_GT(cv::countNonZero(fields.edges), 300);
  for (int k = 0; k < 40; ++k) {
    const SinCos way = sin_cos(2 * kPi * k / 40);
    const double x = 100 + 66 * way.cos, y = 100 + 66 * way.sin;
    const double turn = (fields.direction.angle(x, y) - atan2_portable(way.sin, way.cos)) / (kPi / 2);
    EXPECT_NEAR(turn, std::round(turn), 0.1) << k;
  }
}

TEST(MosaicFields, AverageTilesCoverThePicture) {
  const cv::Mat3b picture = disc_photo();
  for (const double variation : {1.0, 2.0, 6.0}) {
    Params params;
    params.variation = variation;
    const Fields fields = make_fields({view_of(picture), {}, {}, {}}, params, 9);
    double tiles = 0, least = 1e9, most = 0;
    for (const float side : fields.sides) {
      tiles += 1.0 / (static_cast<double>(side) * side);
      least = std::min<double>(least, side);
      most = std::max<double>(most, side);
    }
    EXPECT_NEAR(tiles / static_cast<double>(fields.sides.total()), 1.0 / 81, 1e-4);
    EXPECT_LE(most, variation * least * 1.001);
  }
}

TEST(MosaicFields, DetailGetsSmallerTiles) {
  const cv::Mat3b picture = paint(200, 100, [](double x, double y) {
    const int v = x < 100 ? 128 : static_cast<int>(128 + 100 * std::sin(x * 1.3) * std::sin(y * 1.1));
    return cv::Vec3b(v, v, v);
  });
  Params params;
  params.variation = 4;
  const Fields fields = make_fields({view_of(picture), {}, {}, {}}, params, 6);
  EXPECT_GT(fields.side(30, 50), 2 * fields.side(170, 50));
}

TEST(MosaicFields, SalientThingsGetSmallerTilesHoweverPlain) {
  // Two plain discs: a red one, rare, and one in nearly the ground's colour but noisy.
  const cv::Mat3b picture = paint(200, 100, [](double x, double y) {
    const int v = static_cast<int>(128 + 12 * std::sin(x * 1.3) * std::sin(y * 1.1));
    return std::hypot(x - 50, y - 50) < 20    ? cv::Vec3b(220, 40, 30)
           : std::hypot(x - 150, y - 50) < 20 ? cv::Vec3b(v, v, v)
                                              : cv::Vec3b(128, 128, 128);
  });
  Params params;
  params.variation = 4;
  const Pictures pictures{view_of(picture), {}, {}, {}};
  const Fields by_detail = make_fields(pictures, params, 6);
  EXPECT_GT(by_detail.side(50, 50), 1.3 * by_detail.side(150, 50));
  params.sizes_by = SizesBy::kSaliency;
  const Fields by_saliency = make_fields(pictures, params, 6);
  EXPECT_LT(by_saliency.side(50, 50), 0.6 * by_saliency.side(150, 50));
}

// As an old lens makes them.
TEST(MosaicFields, DarkCornersAreLessSalientThanWhatIsInTheMiddle) {
  const cv::Mat3b picture = paint(200, 200, [](double x, double y) {
    const double r = std::hypot(x - 100, y - 100);
    const int v = r > 110 ? 40 : 170;
    return r < 25 ? cv::Vec3b(200, 90, 80) : cv::Vec3b(v, v, v);
  });
  Params params;
  params.variation = 4;
  params.sizes_by = SizesBy::kSaliency;
  const Fields fields = make_fields({view_of(picture), {}, {}, {}}, params, 6);
  for (const int x : {8, 192})
    for (const int y : {8, 192}) EXPECT_LT(fields.side(100, 100), 0.95 * fields.side(x, y)) << x << ' ' << y;
}

TEST(MosaicFields, TheUsersPicturesAreObeyed) {
  const cv::Mat3b picture = disc_photo();
  const cv::Mat3b lines = paint(320, 320, [](double x, double) {
    return std::fabs(x - 100) < 3 ? cv::Vec3b(0, 0, 0) : cv::Vec3b(255, 255, 255);
  });
  const cv::Mat3b slanted =
      paint(50, 50, [](double, double) { return cv::Vec3b(43, 43, 43); });  // 43 / 255 of 180 degrees
  const Fields fields = make_fields({view_of(picture), view_of(lines), view_of(slanted), {}}, {}, 8);
  EXPECT_LT(at(fields.distance, 50, 20), 2);
  EXPECT_GT(at(fields.distance, 80, 34), 20);  // the disc's own edge is no edge any more
  EXPECT_NEAR(fields.direction.angle(70, 70), 43.0 / 255 * kPi, 1e-3);
}

TEST(MosaicSites, RowsKeepTheirDistance) {
  const cv::Mat3b picture = disc_photo(240);
  Params params;
  params.tiles = 500;
  Fields fields = make_fields({view_of(picture), {}, {}, {}}, params, 240 / std::sqrt(500.0));
  const Sites sites = rows_of_sites(fields, params);
  EXPECT_NEAR(static_cast<double>(sites.size()), 500, 40);
  for (std::size_t i = 0; i < sites.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      ASSERT_GT(std::hypot(sites[i].x - sites[k].x, sites[i].y - sites[k].y), 0.5 * sites[i].extent_u)
          << i << ' ' << k;
}

TEST(MosaicSites, RandomOnesAreDenserWhereTilesAreSmall) {
  const cv::Mat3b picture = plain_photo(200, 100);
  const cv::Mat3b halves =
      paint(200, 100, [](double x, double) { return x < 100 ? cv::Vec3b(255, 0, 255) : cv::Vec3b(0, 255, 0); });
  Params params;
  params.tiles = 4000;
  const Fields fields = make_fields({view_of(picture), {}, {}, view_of(halves)}, params, 4);
  int left = 0;
  for (const Site& site : random_sites(fields, params, 5)) left += site.x < 100;
  EXPECT_NEAR(left, 4000 * 4.0 / 5, 150);  // half the size, four times as many
}

TEST(RegionSizes, AreReadOrRefused) {
  std::vector<RegionSize> sizes;
  ASSERT_TRUE(parse_region_sizes("#0000ff=1.6, 00ff00=1", sizes));
  ASSERT_EQ(sizes.size(), 2u);
  EXPECT_EQ(sizes[0].colour, (Rgb{0, 0, 255}));
  EXPECT_DOUBLE_EQ(sizes[0].size, 1.6);
  for (const char* wrong : {"", "blue=1", "#0000ff", "#0000ff=", "#0000ff=0", "#0000ff=21", "#0000ff=nan", "#00ff=1"})
    EXPECT_FALSE(parse_region_sizes(wrong, sizes)) << wrong;
}

TEST(TilePalette, IsReadOrRefused) {
  TilePalette palette;
  ASSERT_TRUE(parse_palette("", palette));
  EXPECT_TRUE(palette.count == 0 && palette.materials.empty());
  ASSERT_TRUE(parse_palette("12", palette));
  EXPECT_EQ(palette.count, 12);
  ASSERT_TRUE(parse_palette("warm chalk #f4f1e8, #842;", palette));
  ASSERT_EQ(palette.materials.size(), 2u);
  EXPECT_EQ(palette.materials[0].name, "warm chalk");
  EXPECT_EQ(palette.materials[1].colour, (Rgb{0x88, 0x44, 0x22}));
  for (const char* wrong : {"1", "257", "2.5", "red", "red #12345", "#123456 red"})
    EXPECT_FALSE(parse_palette(wrong, palette)) << wrong;
}

TEST(TileColours, AreTheMeanInLinearLight) {
  const cv::Mat3b stripes =
      paint(4, 4, [](double x, double) { return x < 2 ? cv::Vec3b(0, 0, 0) : cv::Vec3b(255, 255, 255); });
  const Ring whole = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  const Rgb mean = tile_colours(view_of(stripes), {whole}, Sample::kMean)[0];
  EXPECT_EQ(mean, (Rgb{188, 188, 188}));  // half of the light, not half of the level
  const Ring left = {{0, 0}, {2, 0}, {2, 4}, {0, 4}}, tiny = {{3.1, 3.1}, {3.2, 3.1}, {3.2, 3.2}};
  EXPECT_EQ(tile_colours(view_of(stripes), {left, tiny}, Sample::kMean)[1], (Rgb{255, 255, 255}));
}

TEST(TileColours, OfEveryLevelAloneIsThatLevel) {
  for (int v = 0; v < 256; ++v) {
    const cv::Mat3b flat = paint(2, 2, [=](double, double) { return cv::Vec3b(v, v, v); });
    const Rgb mean = tile_colours(view_of(flat), {{{0, 0}, {2, 0}, {2, 2}, {0, 2}}}, Sample::kMean)[0];
    EXPECT_EQ(static_cast<int>(mean.g), v);
  }
}

TEST(LimitColours, TakesTheNearestOfAList) {
  std::vector<Rgb> colours = {{250, 10, 10}, {20, 20, 240}, {200, 30, 40}};
  const auto materials = limit_colours("brick #cc2020, sky #2020cc", colours);
  ASSERT_EQ(materials.size(), 2u);
  EXPECT_THAT(colours, ElementsAre(materials[0].colour, materials[1].colour, materials[0].colour));
}

TEST(LimitColours, FindsAsManyAsItIsTold) {
  Rng rng(4, RngPurpose::kColours);
  std::vector<Rgb> colours;
  for (int i = 0; i < 500; ++i) {
    const auto near = [&](int v) { return static_cast<std::uint8_t>(v + rng.bits() % 9); };
    const int k = i % 3;
    colours.push_back(k == 0   ? Rgb{near(200), near(30), near(30)}
                      : k == 1 ? Rgb{near(30), near(180), near(30)}
                               : Rgb{near(20), near(30), near(220)});
  }
  const auto before = colours;
  EXPECT_EQ(limit_colours("3", colours).size(), 3u);
  for (std::size_t i = 3; i < colours.size(); ++i) EXPECT_EQ(colours[i], colours[i % 3]);
  EXPECT_LT(std::abs(colours[0].r - before[0].r), 12);
}

}  // namespace
}  // namespace tessera::mosaic
