#include <gtest/gtest.h>

#include <numeric>

#include "boards.h"
#include "tessera/parquetry/order.h"

namespace tessera::parquetry {
namespace {

TEST(Tones, AreThoseOfTheWoodInTheirOrder) {
  Histogram target{}, wood{};
  target[10] = target[20] = target[30] = target[40] = 25;
  wood[100] = wood[110] = wood[120] = wood[130] = 7;
  const Tones all = matched_tones(target, wood, 1);
  EXPECT_EQ(all[10], 100);
  EXPECT_EQ(all[20], 110);
  EXPECT_EQ(all[30], 120);
  EXPECT_EQ(all[40], 130);
  const Tones half = matched_tones(target, wood, 0.5), none = matched_tones(target, wood, 0);
  EXPECT_EQ(half[10], 55);
  for (int level = 0; level < 256; ++level) EXPECT_EQ(none[level], level);
}

TEST(Tones, ComeFromInsideTheMasksOnly) {
  cv::Mat1b levels(2, 3, std::uint8_t{200}), mask(2, 3, std::uint8_t{0});
  levels(0, 1) = 7;
  mask(0, 1) = 255;
  const Histogram counted = histogram_of(levels, mask);
  EXPECT_EQ(counted[7], 1);
  EXPECT_EQ(std::accumulate(counted.begin(), counted.end(), std::int64_t{0}), 1);

  // White beyond the masks changes nothing of what is matched.
  Rng rng(2, RngPurpose::kShapes);
  std::vector<Panel> panels{board(rng, {60, 50}, 4)}, other = panels;
  other[0].scan.setTo(cv::Scalar(255, 255, 255), other[0].mask == 0);
  const cv::Mat3b target = blotches(rng, {30, 30});
  Params params;
  params.weight_histogram = 1;
  EXPECT_EQ(cv::norm(SlowMatcher(panels, target, params).features, SlowMatcher(other, target, params).features,
                     cv::NORM_INF),
            0);
}

TEST(Features, AreScaledByTheirWeights) {
  Params params;
  params.weight_intensity = 0.25;
  params.weight_edge = 0.5;
  cv::Mat3b step(5, 6, cv::Vec3b(40, 40, 40));
  step.colRange(3, 6).setTo(cv::Scalar(100, 100, 100));
  const cv::Mat features = features_of(step, params);
  ASSERT_EQ(features.channels(), 2);
  EXPECT_EQ(features.at<cv::Vec2b>(2, 0), cv::Vec2b(20, 0));
  EXPECT_EQ(features.at<cv::Vec2b>(2, 2), cv::Vec2b(20, 60));  // a step of 60 is an edge of 60
  EXPECT_EQ(features.at<cv::Vec2b>(2, 5), cv::Vec2b(50, 0));
  params.weight_intensity = params.weight_edge = 0;
  EXPECT_EQ(cv::countNonZero(features_of(step, params)), 0);
  params.weight_colour = 1;
  EXPECT_EQ(feature_channels(params), 2);
}

TEST(Turn, ByRightAnglesMovesWholePixels) {
  cv::Mat1b picture(3, 5);
  std::iota(picture.begin(), picture.end(), std::uint8_t{1});
  for (int quarter = 0; quarter < 4; ++quarter) {
    const Turn turn(picture.size(), 90 * quarter);
    cv::Mat1b expected = picture.clone();
    for (int i = 0; i < quarter; ++i) cv::rotate(expected, expected, cv::ROTATE_90_CLOCKWISE);
    ASSERT_EQ(turn.size(), expected.size());
    const Rows rows = turn.turned(picture, 5);
    for (int y = 0; y < expected.rows; ++y)
      for (int x = 0; x < expected.cols; ++x) EXPECT_EQ(*rows.at(y, x), expected(y, x)) << quarter;
  }
}

// A placement says where a point of the target comes from on the panel; the frame has the same picture there.
TEST(Turn, AgreesWithPlacements) {
  const Turn turn({200, 120}, 72);
  const Placement placement = place(turn, 3, {20, 16}, {60, 90}, {310, 208});  // box at (300, 200)
  const Polygon cut = on_panel(placement, Polygon{{{300, 200}, {320, 200}, {320, 216}, {300, 216}}, {}});
  const Point corners[] = {{60, 90}, {80, 90}, {80, 106}, {60, 106}};
  for (int i = 0; i < 4; ++i) EXPECT_LT(length(cut.outer[i] - turn.to_picture(corners[i])), 1e-9);
}

TEST(Grain, LimitsTheRotations) {
  Params params;
  params.rotations = 8;
  EXPECT_EQ(allowed_rotations(params).size(), 8u);
  params.grain = Grain::kAligned;
  EXPECT_EQ(allowed_rotations(params), (std::vector<int>{0, 4}));
  params.grain = Grain::kDegrees;
  params.grain_degrees = 44.9;
  EXPECT_EQ(allowed_rotations(params), (std::vector<int>{0, 4}));
  params.grain_degrees = 45;
  EXPECT_EQ(allowed_rotations(params), (std::vector<int>{0, 1, 3, 4, 5, 7}));
  params.rotations = 15;
  params.grain = Grain::kAligned;
  EXPECT_EQ(allowed_rotations(params), std::vector<int>{0});
}

TEST(Grid, CoversTheTargetEvenly) {
  for (const int side : {7, 13, 48, 100, 101, 487}) {
    Params params;
    params.patch_mm = 12;
    params.min_width_mm = 9;
    const std::vector<Patch> patches = grid_patches({side, 60}, params, 1);
    const int parts = patches.back().column + 1;
    double sum = 0;
    for (const Patch& patch : patches) {
      sum += area(patch.outline);
      EXPECT_GE(patch.box.width, std::min(side, 9));
      EXPECT_LT(std::abs(patch.box.width - static_cast<double>(side) / parts), 1);  // all alike
    }
    EXPECT_EQ(sum, side * 60.0);
  }
  EXPECT_EQ(even_cuts(912, 48, 17).size(), 20u);
  EXPECT_EQ(even_cuts(20, 3, 9), (std::vector<int>{0, 10, 20}));
  EXPECT_EQ(even_cuts(5, 3, 9), (std::vector<int>{0, 5}));
}

TEST(Order, IsThatOfItsMeasure) {
  Params params;
  params.patch_mm = 10;
  cv::Mat3b target(30, 30, cv::Vec3b(100, 100, 100));
  target(cv::Rect(20, 0, 10, 10)).setTo(cv::Scalar(255, 40, 40));
  std::vector<Patch> patches = grid_patches({30, 30}, params, 1);
  const std::vector<Patch> second = grid_patches({30, 30}, params, 1, 1);
  patches.insert(patches.end(), second.begin(), second.end());
  const std::vector<cv::Mat3b> targets{target, target};
  EXPECT_EQ(order_of(patches, targets, Order::kSaliency, false)[0], 2);
  EXPECT_EQ(order_of(patches, targets, Order::kCentre, false)[0], 4);
  EXPECT_EQ(order_of(patches, targets, Order::kRows, false)[5], 5);
  EXPECT_EQ(order_of(patches, targets, Order::kCentre, false)[1], 1);
  // Interleaved, the best of either target come first.
  EXPECT_EQ(order_of(patches, targets, Order::kSaliency, true)[1], 11);
  EXPECT_EQ(order_of(patches, targets, Order::kCentre, true)[1], 13);
}

}  // namespace
}  // namespace tessera::parquetry
