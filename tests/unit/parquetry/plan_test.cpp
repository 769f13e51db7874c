#include "tessera/parquetry/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scans.h"
#include "tessera/parquetry/patches.h"

namespace tessera::parquetry {
namespace {

using ::testing::HasSubstr;

Plan plan_of_grids(const std::vector<cv::Size>& targets, const Params& params) {
  std::vector<Patch> patches;
  for (std::size_t i = 0; i < targets.size(); ++i)
    for (const Patch& patch : grid_patches(targets[i], params, 0.25, static_cast<int>(i))) patches.push_back(patch);
  return plan_of(targets, patches, params, 0.25);
}

TEST(Plan, ClosedForm) {
  Params params;
  params.image_size_mm = 120;
  params.patch_mm = 10;
  params.kerf_mm = 0.2;
  params.clearance_mm = 1;
  params.cut_speed = 10;
  const Plan plan = plan_of_grids({{720, 480}}, params);
  EXPECT_EQ(plan.rows, 12);
  EXPECT_EQ(plan.columns, 18);
  EXPECT_EQ(plan.pieces, 216);
  EXPECT_NEAR(plan.width_mm, 180, 0.2);
  EXPECT_NEAR(plan.wood_mm2, 180 * 120, 60);
  EXPECT_NEAR(plan.taken_mm2, 216 * 11.2 * 11.2, 100);
  EXPECT_NEAR(plan.cut_mm, 216 * 4 * 10.2, 20);
  EXPECT_NEAR(plan.minutes, plan.cut_mm / 600, 1e-9);
}

TEST(Plan, OfSeveralTargetsIsTheirSum) {
  Params params;
  params.image_size_mm = 120;
  const Plan first = plan_of_grids({{720, 480}}, params), second = plan_of_grids({{480, 480}}, params);
  const Plan both = plan_of_grids({{720, 480}, {480, 480}}, params);
  EXPECT_EQ(both.pieces, first.pieces + second.pieces);
  EXPECT_NEAR(both.taken_mm2, first.taken_mm2 + second.taken_mm2, 1e-6);
  EXPECT_NEAR(both.minutes, first.minutes + second.minutes, 1e-9);
  EXPECT_THAT(describe(both, params), HasSubstr(std::to_string(both.pieces) + " pieces of 2 targets"));
}

Panel plain_panel(int side, std::uint8_t level) {
  Panel panel;
  panel.name = "oak";
  panel.mm_per_px = 0.5;
  panel.scan = cv::Mat3b(side, side, cv::Vec3b(level, level, level));
  panel.mask = cv::Mat1b(side, side, static_cast<std::uint8_t>(255));
  return panel;
}

TEST(Forecast, ComparesTonesWithTheWood) {
  Params params;
  params.image_size_mm = 100;
  params.patch_mm = 10;
  params.weight_histogram = 0;
  cv::Mat3b target(200, 200, cv::Vec3b(250, 250, 250));
  target(cv::Rect(0, 0, 100, 200)).setTo(cv::Vec3b(5, 5, 5));
  const std::vector<Panel> panels = {plain_panel(300, 240), plain_panel(100, 10)};
  const cv::Mat3b sized = at_resolution(target, params, 0.5);
  const std::vector<Patch> patches = grid_patches(sized.size(), params, 0.5);
  const Forecast forecast = forecast_of({sized}, patches, panels, params);
  EXPECT_NEAR(forecast.free_mm2[0], 150 * 150, 1e-6);
  EXPECT_NEAR(forecast.tones.back().free_mm2, 150 * 150, 1e-6);
  EXPECT_NEAR(forecast.tones.front().free_mm2, 50 * 50, 1e-6);
  EXPECT_NEAR(forecast.tones.front().needed_mm2, forecast.plan.taken_mm2 / 2, 1);
  EXPECT_NEAR(forecast.tones.back().needed_mm2, forecast.plan.taken_mm2 / 2, 1);
  const std::string text = describe(forecast, panels, params);
  EXPECT_THAT(text, HasSubstr("The wood suffices"));
  EXPECT_THAT(text, HasSubstr("Of dark wood some"));
  EXPECT_THAT(describe(forecast_of({sized}, patches, {plain_panel(100, 240)}, params), {panels[1]}, params),
              HasSubstr("does not suffice"));
}

}  // namespace
}  // namespace tessera::parquetry
