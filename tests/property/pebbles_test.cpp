// What holds of every field of pebbles, over painted beaches of many seeds and over pictures of nothing.
#include <gtest/gtest.h>

#include <cmath>

#include "../unit/image_views.h"
#include "../unit/pebbles/beach.h"
#include "tessera/pebbles/run.h"

namespace tessera::pebbles {
namespace {

Output found(const cv::Mat3b& photo, const Params& params = {}) {
  auto output = run({view_of(photo), {}}, params, 1, {});
  EXPECT_TRUE(output);
  return *std::move(output);
}

class Beaches : public testing::TestWithParam<int> {};

// A stone may be joined to its neighbour or to the sand: the search weighs looks. Most are not.
TEST_P(Beaches, TwoStonesOfThreeAreFoundInTheirSize) {
  const Beach beach = paint_beach(7, 5, GetParam());
  const Output output = found(beach.photo);
  int right = 0;
  for (const Stone& stone : beach.stones) {
    const int label = output.labels(static_cast<int>(stone.y), static_cast<int>(stone.x));
    if (label == 0) continue;
    const Grain& grain = output.grains[label - 1];
    const bool fits = std::fabs(grain.a - 2 * stone.a) < 0.2 * stone.a + 1 &&
                      std::fabs(grain.b - 2 * stone.b) < 0.2 * stone.b + 1 &&
                      std::fabs(grain.area / (kPi * stone.a * stone.b) - 1) < 0.15;
    right += fits ? 1 : 0;
  }
  EXPECT_GE(right, 24);
  EXPECT_LE(output.pebbles.size(), 39);
}

TEST_P(Beaches, LabelsPebblesPiecesAndNodesAreTheSame) {
  const Beach beach = paint_beach(5, 4, 100 + GetParam());
  const Output output = found(beach.photo);
  std::vector<int> pixels(output.pebbles.size() + 1, 0);
  for (const int label : output.labels) {
    ASSERT_GE(label, 0);
    ASSERT_LE(label, static_cast<int>(output.pebbles.size()));
    ++pixels[label];
  }
  ASSERT_EQ(output.sheet.pieces.size(), output.pebbles.size());
  ASSERT_EQ(output.scene.nodes.size(), output.pebbles.size());
  for (std::size_t k = 0; k < output.pebbles.size(); ++k) {
    const Pebble& pebble = output.pebbles[k];
    EXPECT_EQ(pebble.id, static_cast<int>(k) + 1);
    EXPECT_EQ(output.sheet.pieces[k].id, pebble.id);
    EXPECT_EQ(output.scene.nodes[k].name, "pebble-" + std::to_string(pebble.id));
    EXPECT_GT(pixels[pebble.id], 0);
    EXPECT_EQ(pebble.area_px, pixels[pebble.id]);
    for (const double r : pebble.radii) EXPECT_TRUE(std::isfinite(r) && r > 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Beaches, testing::Range(1, 9));

TEST(PebblesProperty, TwoPixelsLessMoveFewStones) {
  const Beach beach = paint_beach(8, 6, 3);
  const Output whole = found(beach.photo);
  const Output cropped = found(beach.photo(cv::Rect(2, 2, beach.photo.cols - 2, beach.photo.rows - 2)).clone());
  int moved = 0;
  for (const Pebble& pebble : whole.pebbles) {
    const Point expected = pebble.centre - Point{2, 2};
    const int label = cropped.labels(static_cast<int>(expected.y), static_cast<int>(expected.x));
    const bool stays = label > 0 && length(cropped.pebbles[label - 1].centre - expected) < 1;
    moved += stays ? 0 : 1;
  }
  EXPECT_LE(moved, 4) << "of " << whole.pebbles.size();
}

TEST(PebblesProperty, PicturesOfNothingHoldNoPebbles) {
  Rng rng(1, RngPurpose::kNoise);
  cv::Mat3b noise(90, 120);
  for (cv::Vec3b& v : noise)
    for (int c = 0; c < 3; ++c) v[c] = static_cast<std::uint8_t>(rng.bits() & 255);
  cv::Mat3b board(90, 120);
  for (int y = 0; y < board.rows; ++y)
    for (int x = 0; x < board.cols; ++x) board(y, x) = cv::Vec3b::all((x + y) % 2 ? 255 : 0);
  for (const cv::Mat3b& picture : {noise, board, cv::Mat3b(90, 120, {128, 128, 128}), cv::Mat3b(1, 1, {0, 0, 0}),
                                   cv::Mat3b(1, 200, {9, 9, 9})}) {
    int warnings = 0;
    RunContext context;
    context.on_warning = [&](std::string_view) { ++warnings; };
    const auto output = run({view_of(picture), {}}, {}, 1, context);
    ASSERT_TRUE(output);
    EXPECT_TRUE(output->pebbles.empty());
    EXPECT_EQ(warnings, 1);
  }
}

TEST(PebblesProperty, AStoppedRunSaysSo) {
  const std::atomic<int> stop{static_cast<int>(StopReason::kCancelled)};
  RunContext context;
  context.stop = &stop;
  const Beach beach = paint_beach(3, 3, 1);
  const auto output = run({view_of(beach.photo), {}}, {}, 1, context);
  ASSERT_FALSE(output);
  EXPECT_EQ(output.error().code, StatusCode::kCancelled);
}

}  // namespace
}  // namespace tessera::pebbles
