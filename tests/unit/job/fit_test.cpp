#include "tessera/job/fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tessera/formats/formats.h"
#include "tessera/patterns/run.h"

namespace tessera {
namespace {

using patterns::Model;

Result<Fit> fit_of(const patterns::Params& params, std::uint64_t seed, double scale = 1) {
  const Raster picture = draw_sheet(patterns::run({}, params, seed, {})->sheet, scale);
  return fit_pattern({picture.bytes.data(), picture.width, picture.height, std::ptrdiff_t{3} * picture.width}, 1, {});
}

patterns::Params params_of(Model model) {
  patterns::Params params;
  params.model = model;
  params.width = params.height = 400;
  params.size = 12;
  return params;
}

TEST(FitTest, NamesTheModelThatMadeThePicture) {
  for (const Model model : {Model::kPoissonLines, Model::kOccupancy, Model::kDelaunay, Model::kJohnsonMehl,
                            Model::kCheckerboard, Model::kHexagon, Model::kTriangle, Model::kGaussian}) {
    const auto fit = fit_of(params_of(model), 11);
    ASSERT_TRUE(fit.has_value()) << fit.error().message;
    EXPECT_EQ(fit->candidates[0].model, model) << static_cast<int>(fit->candidates[0].model);
    EXPECT_EQ(fit->params.model, model);
  }
}

// A lattice's side is in each of its cells; a thousand random cells tell their density to some percent.
TEST(FitTest, FindsTheNumber) {
  EXPECT_NEAR(fit_of(params_of(Model::kCheckerboard), 3)->candidates[0].number / 12, 1, 0.03);
  EXPECT_NEAR(fit_of(params_of(Model::kHexagon), 3, 2)->candidates[0].number / 24, 1, 0.03);
  EXPECT_NEAR(fit_of(params_of(Model::kOccupancy), 3)->candidates[0].number * 144, 1, 0.12);
  EXPECT_EQ(fit_of(params_of(Model::kGaussian), 3, 3)->candidates[0].number, 3);
}

TEST(FitTest, TakesTheColoursAndTheirShares) {
  patterns::Params params = params_of(Model::kOccupancy);
  params.colors = "#102030 #e0e0e0";
  params.probabilities = "0.7 0.3";
  const auto fit = fit_of(params, 5);
  ASSERT_TRUE(fit.has_value());
  EXPECT_EQ(fit->params.colors, "#102030 #e0e0e0");
  EXPECT_NEAR(std::stod(fit->params.probabilities), 0.7, 0.05);
  EXPECT_EQ(fit->params.width, 400);
}

TEST(FitTest, StopsWhenAsked) {
  const std::atomic<int> stop{static_cast<int>(StopReason::kTimeout)};
  RunContext context;
  context.stop = &stop;
  const Raster picture = draw_sheet(patterns::run({}, params_of(Model::kOccupancy), 1, {})->sheet);
  const auto fit = fit_pattern({picture.bytes.data(), 400, 400, 1200}, 1, context);
  ASSERT_FALSE(fit.has_value());
  EXPECT_EQ(fit.error().code, StatusCode::kTimeout);
}

}  // namespace
}  // namespace tessera
