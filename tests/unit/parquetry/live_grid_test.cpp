#include "tessera/parquetry/live_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "../image_views.h"
#include "drawn_targets.h"
#include "tessera/parquetry/morphed_patches.h"

namespace tessera::parquetry {
namespace {

using ::testing::HasSubstr;

std::vector<Point> vertices_of(const MorphingGrid& grid) {
  std::vector<Point> all;
  for (int row = 0; row <= grid.down(); ++row)
    for (int column = 0; column <= grid.across(); ++column) all.push_back(grid.vertex(column, row));
  return all;
}

// As a job has it.
std::vector<Point> settled(const cv::Mat3b& target, const Params& params, const EdgeMasks& masks = {}) {
  const EdgePicture edges = edge_picture_of(target, params, kMm, masks);
  auto grid = morphing_grid_of(target.size(), edges, params, kMm);
  EXPECT_TRUE(grid);
  grid->settle();
  return vertices_of(*grid);
}

TEST(LiveGrid, RelaxesToWhatAJobMakes) {
  Rng rng(11, RngPurpose::kShapes);
  for (int seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    Params params = morphed();
    params.attraction = 1 + seed;
    if (seed % 2 == 1) params.pins = "2,2:26,25";
    const cv::Mat3b target = shapes(rng, {6 * kCell, 5 * kCell}, 6);
    LiveGrid live(target, params, kMm);
    ASSERT_TRUE(live.begin(params, {}));
    const std::vector<Point> even = vertices_of(live.grid());
    EXPECT_EQ(even[8], (Point{kCell, kCell}));
    int steps = 0;
    for (int more = 1; more > 0; steps += more) more = live.step(1 + seed);
    EXPECT_GT(steps, 10);
    EXPECT_LE(steps, 400);
    EXPECT_EQ(vertices_of(live.grid()), settled(target, params));
    EXPECT_NE(vertices_of(live.grid()), even);
  }
}

TEST(LiveGrid, IsThatOfAJobWhereAVertexIsLetGo) {
  Rng rng(12, RngPurpose::kShapes);
  const auto whole = [&](int below) { return static_cast<int>(rng.uniform(0, below)); };
  int near = 0, laid = 0;
  for (int seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    Params params = morphed();
    params.min_width_mm = 4 + seed % 5;
    const cv::Mat3b target = shapes(rng, {6 * kCell, 5 * kCell}, 6);
    LiveGrid live(target, params, kMm);
    ASSERT_TRUE(live.begin(params, {}));
    live.step(400);
    for (int drag = 0; drag < 5; ++drag) {
      const int column = whole(7), row = whole(6);
      const Point from = live.grid().vertex(column, row);
      const Point to = kMm * (from + Point{rng.uniform(-1.5, 1.5) * kCell, rng.uniform(-1.5, 1.5) * kCell});
      for (int step = 0; step < 40; ++step) live.drag(column, row, to), live.step(1);
      const Point let_go = live.grid().vertex(column, row);
      const std::string before = params.pins;
      params.pins = live.lay();
      ASSERT_TRUE(morphed_patches(target, params, kMm)) << params.pins;
      EXPECT_EQ(vertices_of(live.grid()), settled(target, params));
      EXPECT_EQ(live.step(1), 0);
      laid += params.pins != before;
      near += params.pins != before && length(live.grid().vertex(column, row) - let_go) < 0.02 / kMm;
    }
  }
  EXPECT_GE(laid, 34);
  EXPECT_GE(near, 28);
}

TEST(LiveGrid, LaysNothingThatWasNotDragged) {
  Params params = morphed();
  params.pins = "1,1:11,13; 2,3:25,36.5";
  Rng rng(13, RngPurpose::kShapes);
  const cv::Mat3b target = shapes(rng, {4 * kCell, 4 * kCell}, 4);
  LiveGrid live(target, params, kMm);
  ASSERT_TRUE(live.begin(params, {}));
  EXPECT_EQ(live.lay(), params.pins);
  // The pin of a vertex that is dragged again is replaced.
  live.step(400);
  for (int step = 0; step < 30; ++step) live.drag(1, 1, {13, 12}), live.step(1);
  EXPECT_EQ(live.lay(), "2,3:25,36.5; 1,1:13,12");
}

TEST(LiveGrid, FindsEdgesOnceAndMasksThemOften) {
  Rng rng(14, RngPurpose::kShapes);
  const cv::Mat3b target = shapes(rng, {5 * kCell, 5 * kCell}, 6), other = shapes(rng, {5 * kCell, 5 * kCell}, 6);
  Params params = morphed();
  LiveGrid live(target, params, kMm);
  EXPECT_TRUE(live.is_of(target.clone(), params, kMm));
  EXPECT_FALSE(live.is_of(other, params, kMm));
  EXPECT_FALSE(live.is_of(target, params, 2 * kMm));
  cv::Mat1b left(4, 4, static_cast<std::uint8_t>(0));
  left.colRange(0, 2).setTo(255);
  for (const EdgeMasks& masks : {EdgeMasks{left, {}}, EdgeMasks{{}, left}, EdgeMasks{left, left}}) {
    ASSERT_TRUE(live.begin(params, masks));
    while (live.step(50) > 0) continue;
    EXPECT_EQ(vertices_of(live.grid()), settled(target, params, masks));
    EXPECT_GT(cv::countNonZero(live.found().bilateral), 100);
  }
  // One that cannot begin leaves all as it was.
  const std::vector<Point> before = vertices_of(live.grid());
  Params wrong = params;
  wrong.pins = "9,9:1,1";
  const auto refused = live.begin(wrong, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().field, "pins");
  EXPECT_EQ(vertices_of(live.grid()), before);
  EXPECT_EQ(live.lay(), "");
  wrong.patch_mm *= 2;
  EXPECT_FALSE(live.is_of(target, wrong, kMm));
}

TEST(EdgeMasks, AreTheRedAndTheBlueOfAPicture) {
  cv::Mat3b picture(2, 4, cv::Vec3b(0, 0, 0));
  picture(0, 1) = {255, 0, 0};
  picture(0, 2) = {0, 255, 255};
  picture(0, 3) = {255, 255, 255};
  picture(1, 0) = {127, 0, 128};
  const auto masks = edge_masks_of(view_of(picture), {400, 200});
  ASSERT_TRUE(masks);
  const cv::Mat1b large = (cv::Mat1b(2, 4) << 0, 255, 0, 255, 0, 0, 0, 0);
  const cv::Mat1b fine = (cv::Mat1b(2, 4) << 0, 0, 255, 255, 255, 0, 0, 0);
  EXPECT_EQ(cv::countNonZero(masks->rolling_guidance != large), 0);
  EXPECT_EQ(cv::countNonZero(masks->bilateral != fine), 0);
  EXPECT_TRUE(edge_masks_of({}, {400, 200})->bilateral.empty());
  const auto wrong = edge_masks_of(view_of(picture), {400, 205});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().field, "edge-mask");
  EXPECT_THAT(wrong.error().message, HasSubstr("400 to 205"));
}

TEST(Pins, AreWrittenAsTheyAreRead) {
  EXPECT_EQ(write_pins({}), "");
  EXPECT_EQ(write_pins({{3, 4, {123.456, -0.001}}, {0, 12, {0, 1234.5}}}), "3,4:123.46,0; 0,12:0,1234.5");
  Rng rng(15, RngPurpose::kShapes);
  std::vector<Pin> pins;
  for (int i = 0; i < 200; ++i) pins.push_back({i, 2 * i, {rng.uniform(-1e5, 1e5), rng.uniform(0, 0.1)}});
  const std::string text = write_pins(pins);
  const std::vector<Pin> read = read_pins(text, [](const std::string& message) { ADD_FAILURE() << message; });
  ASSERT_EQ(read.size(), pins.size());
  for (std::size_t i = 0; i < pins.size(); ++i) {
    EXPECT_EQ(read[i].row, pins[i].row);
    EXPECT_NEAR(read[i].at.x, pins[i].at.x, 0.00501);
    EXPECT_NEAR(read[i].at.y, pins[i].at.y, 0.00501);
  }
  EXPECT_EQ(write_pins(read), text);
}

}  // namespace
}  // namespace tessera::parquetry
