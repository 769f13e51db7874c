#include "tessera/patterns/colours.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tessera/patterns/pixel_noise.h"
#include "tessera/patterns/run.h"

namespace tessera::patterns {
namespace {

std::vector<std::string> troubles(const std::string& colors, const std::string& probabilities,
                                  const std::string& covariance, int channels = 3,
                                  const std::string& border_color = "#000") {
  ColourModel model;
  Levels border;
  std::vector<std::string> keys;
  for (const ColourProblem& problem :
       read_colours({channels, colors, probabilities, covariance, border_color}, model, border))
    keys.emplace_back(problem.key);
  return keys;
}

ColourModel model_of(int channels, const std::string& colors, const std::string& probabilities,
                     const std::string& covariance) {
  ColourModel model;
  Levels border;
  EXPECT_TRUE(read_colours({channels, colors, probabilities, covariance, "#000"}, model, border).empty());
  return model;
}

TEST(ColoursTest, ReadsWhatIsRight) {
  EXPECT_TRUE(troubles("#102030", "", "0").empty());
  EXPECT_TRUE(troubles("102030, #fff; #00f", "1 2 3", "10;1 2 3;4 1 0 5 0 6").empty());
  EXPECT_TRUE(troubles("#000 #fff", "0.2,0.8", "9 3 0 1 0 0").empty());  // of rank 1
}

TEST(ColoursTest, RefusesWhatIsNot) {
  using testing::ElementsAre;
  EXPECT_THAT(troubles("", "", "1"), ElementsAre("colors"));
  EXPECT_THAT(troubles("cheese", "", "1"), ElementsAre("colors"));
  EXPECT_THAT(troubles("#000 #fff", "1", "1"), ElementsAre("probabilities"));
  EXPECT_THAT(troubles("#000 #fff", "1 0", "1"), ElementsAre("probabilities"));
  EXPECT_THAT(troubles("#000 #fff", "1 -1", "1 2"), ElementsAre("probabilities", "covariance"));
  EXPECT_THAT(troubles("#000 #fff", "1 nan", ""), ElementsAre("probabilities", "covariance"));
  EXPECT_THAT(troubles("#000", "", "-1"), ElementsAre("covariance"));
  EXPECT_THAT(troubles("#000", "", "1 2 0 1 0 1"), ElementsAre("covariance"));  // a correlation of 2
  EXPECT_THAT(troubles("#000", "", "1;2"), ElementsAre("covariance"));
}

TEST(ColoursTest, HaveAsManyChannelsAsAsked) {
  EXPECT_TRUE(troubles("#10203040 #fff", "", "1 2 3 4", 4, "#00000080").empty());
  EXPECT_TRUE(troubles("#10203040", "", "1 2 3 4 5 6 7 8 9 10", 2) == std::vector<std::string>{"covariance"});
  EXPECT_TRUE(troubles("#101010", "", "9", 1).empty());
  EXPECT_THAT(troubles("#10203040", "", "1"), testing::ElementsAre("colors"));
  EXPECT_THAT(troubles("#102030", "", "1", 3, "#00000080"), testing::ElementsAre("borderColor"));
  EXPECT_THAT(troubles("#102030zz", "", "1", 4), testing::ElementsAre("colors"));
  EXPECT_EQ(model_of(1, "#102030", "", "0").classes[0].mean, (Levels{32}));
  EXPECT_EQ(model_of(2, "#10203040", "", "0").classes[0].mean, (Levels{32, 64}));
  EXPECT_EQ(model_of(4, "#10203040", "", "0").classes[0].mean, (Levels{16, 32, 48, 64}));
}

// The fourth channel follows the first as its covariance says.
TEST(ColoursTest, VaryInFourChannels) {
  const ColourModel model = model_of(4, "#80808080", "", "100 0 0 60 80 0 0 25 0 64");
  Rng rng(1, RngPurpose::kColours);
  double ra = 0, aa = 0, ga = 0;
  constexpr int kDraws = 40000;
  for (int i = 0; i < kDraws; ++i) {
    const Levels c = draw_colour(model.classes[0], model.classes[0].mean, 4, rng);
    ra += (c[0] - 128.0) * (c[3] - 128.0) / kDraws, ga += (c[1] - 128.0) * (c[3] - 128.0) / kDraws;
    aa += (c[3] - 128.0) * (c[3] - 128.0) / kDraws;
  }
  EXPECT_NEAR(ra, 60, 2);
  EXPECT_NEAR(ga, 0, 1.3);
  EXPECT_NEAR(aa, 64, 2);
}

TEST(ColoursTest, ComeWithTheirProbabilities) {
  const ColourModel model = model_of(3, "#000 #111 #222", "5 3 2", "0");
  Rng rng(1, RngPurpose::kColours);
  double counts[3] = {};
  constexpr int kDraws = 20000;
  for (int i = 0; i < kDraws; ++i) ++counts[draw_class(model, rng).mean[0] / 17];
  const double expected[] = {0.5, 0.3, 0.2};
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(counts[k] / kDraws, expected[k], 3.5 * std::sqrt(expected[k] * (1 - expected[k]) / kDraws));
}

TEST(ColoursTest, VaryAsTheirCovarianceSays) {
  const ColourModel model = model_of(3, "#808080", "", "100 60 0 80 0 25");
  Rng rng(1, RngPurpose::kColours);
  double rr = 0, rg = 0, gg = 0, rb = 0, bb = 0;
  constexpr int kDraws = 40000;
  for (int i = 0; i < kDraws; ++i) {
    const Levels c = draw_colour(model.classes[0], model.classes[0].mean, 3, rng);
    const double r = c[0] - 128.0, g = c[1] - 128.0, b = c[2] - 128.0;
    rr += r * r / kDraws, rg += r * g / kDraws, gg += g * g / kDraws, rb += r * b / kDraws, bb += b * b / kDraws;
  }
  EXPECT_NEAR(rr, 100, 3);  // three standard errors, and a twelfth for whole levels
  EXPECT_NEAR(gg, 80, 2.5);
  EXPECT_NEAR(bb, 25, 1);
  EXPECT_NEAR(rg, 60, 2);
  EXPECT_NEAR(rb, 0, 1);
}

TEST(MeanFilterTest, EqualsTheSumOverEachSquare) {
  Rng rng(1, RngPurpose::kPixels);
  for (const bool seamless : {false, true})
    for (const int side : {2, 3, 5}) {
      Raster picture{9, 7, 3, 8, {}};
      for (int i = 0; i < 9 * 7 * 3; ++i) picture.bytes.push_back(static_cast<std::uint8_t>(rng.bits() & 255));
      const Raster before = picture;
      mean_filter(picture, side, seamless);
      for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 9; ++x)
          for (int c = 0; c < 3; ++c) {
            double sum = 0;
            for (int j = 0; j < side; ++j)
              for (int i = 0; i < side; ++i) {
                int u = x + i - (side - 1) / 2, v = y + j - (side - 1) / 2;
                u = seamless ? (u + 9) % 9 : std::clamp(u, 0, 8);
                v = seamless ? (v + 7) % 7 : std::clamp(v, 0, 6);
                sum += before.bytes[3 * (9 * v + u) + c];
              }
            EXPECT_NEAR(picture.bytes[3 * (9 * y + x) + c], sum / side / side, 1.01);  // rounded twice
          }
    }
}

TEST(PatternPictureTest, NoiseWithinCellsHasItsVariance) {
  Params params;
  params.colors = "#808080";
  params.covariance = "100";
  params.variation = Variation::kWithin;
  ASSERT_TRUE(has_finish(params));
  Raster picture{200, 200, 3, 8, std::vector<std::uint8_t>(200 * 200 * 3, 128)};
  finish(picture, params, 1);
  double square = 0;
  for (const std::uint8_t level : picture.bytes) square += (level - 128.0) * (level - 128.0) / (200 * 200 * 3);
  EXPECT_NEAR(square, 100, 2);
  params.filter = 5;
  finish(picture, params, 1);
  double smooth = 0;
  for (const std::uint8_t level : picture.bytes) smooth += (level - 128.0) * (level - 128.0) / (200 * 200 * 3);
  EXPECT_LT(smooth, 20);
}

}  // namespace
}  // namespace tessera::patterns
