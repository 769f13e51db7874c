#include "tessera/job/fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "tessera/base/portable_math.h"
#include "tessera/formats/formats.h"
#include "tessera/patterns/run.h"

namespace tessera {
namespace {

using patterns::Model;

Result<Fit> fit_of(const patterns::Params& params, std::uint64_t seed) {
  const Raster picture = draw_sheet(patterns::run({}, params, seed, {})->sheet);
  return fit_pattern({picture.bytes.data(), picture.width, picture.height, std::ptrdiff_t{3} * picture.width}, 1, {});
}

patterns::Params params_of(Model model) {
  patterns::Params params;
  params.model = model;
  params.width = params.height = 360;
  params.size = 12;
  return params;
}

// A lattice's side is in each of its cells; some hundred random cells tell their density to some percent, 68 lines
// to 12.
TEST(FitTest, NamesTheModelThatMadeThePictureAndItsNumber) {
  struct Case {
    Model model;
    double number, tolerance;
  };
  const Case cases[] = {{Model::kPoissonLines, 1 / (12 * std::sqrt(kPi)), 0.3},
                        {Model::kOccupancy, 1 / 144.0, 0.15},
                        {Model::kDelaunay, 1 / 288.0, 0.15},
                        {Model::kJohnsonMehl, 7.02e-4, 0.2},
                        {Model::kCheckerboard, 12, 0.03},
                        {Model::kHexagon, 12, 0.03},
                        {Model::kTriangle, 12, 0.03},
                        {Model::kGaussian, 1, 0}};
  for (const auto& [model, number, tolerance] : cases) {
    const auto fit = fit_of(params_of(model), 11);
    ASSERT_TRUE(fit.has_value()) << fit.error().message;
    EXPECT_EQ(fit->candidates[0].model, model) << static_cast<int>(fit->candidates[0].model);
    EXPECT_EQ(fit->params.model, model);
    EXPECT_NEAR(fit->candidates[0].number / number, 1, tolerance + 1e-9) << static_cast<int>(model);
  }
}

// Its squares change colour twice as often as by chance.
TEST(FitTest, AChessboardIsNoNoise) {
  constexpr int kSide = 240, kSquare = 12;
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < kSide * kSide; ++i)
    pixels.insert(pixels.end(), 3, (i % kSide / kSquare + i / kSide / kSquare) % 2 == 0 ? 0 : 255);
  const auto fit = fit_pattern({pixels.data(), kSide, kSide, std::ptrdiff_t{3} * kSide}, 1, {});
  ASSERT_TRUE(fit.has_value());
  EXPECT_EQ(fit->params.model, Model::kCheckerboard);
}

// Whichever colour is the more frequent one: bombs are found by what they look like.
TEST(FitTest, FindsDiscsOfOneColourOnTheOther) {
  for (const double intensity : {0.002, 0.006}) {
    patterns::Params params = params_of(Model::kCircles);
    params.colors = "#102030 #e0e0e0";
    params.intensity = intensity;
    params.length = 18;
    const auto fit = fit_of(params, 4);
    ASSERT_TRUE(fit.has_value()) << fit.error().message;
    EXPECT_EQ(fit->candidates[0].model, Model::kCircles);
    EXPECT_EQ(fit->params.colors, params.colors);
    EXPECT_NEAR(fit->params.intensity / intensity, 1, 0.15);
    EXPECT_NEAR(fit->params.length / 18, 1, 0.07);
    EXPECT_LT(fit->candidates[0].residual, 0.05);
  }
}

TEST(FitTest, TakesTheColoursAndTheirShares) {
  patterns::Params params = params_of(Model::kOccupancy);
  params.colors = "#102030 #e0e0e0";
  params.probabilities = "0.7 0.3";
  const auto fit = fit_of(params, 5);
  ASSERT_TRUE(fit.has_value());
  EXPECT_EQ(fit->params.colors, "#102030 #e0e0e0");
  EXPECT_NEAR(std::stod(fit->params.probabilities), 0.7, 0.05);
  EXPECT_EQ(fit->params.width, 360);
}

TEST(FitTest, StopsWhenAsked) {
  const std::atomic<int> stop{static_cast<int>(StopReason::kTimeout)};
  RunContext context;
  context.stop = &stop;
  const Raster picture = draw_sheet(patterns::run({}, params_of(Model::kOccupancy), 1, {})->sheet);
  const auto fit = fit_pattern({picture.bytes.data(), 360, 360, 1080}, 1, context);
  ASSERT_FALSE(fit.has_value());
  EXPECT_EQ(fit.error().code, StatusCode::kTimeout);
}

}  // namespace
}  // namespace tessera
