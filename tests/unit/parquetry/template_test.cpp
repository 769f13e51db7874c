#include "tessera/parquetry/template.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "boards.h"

namespace tessera::parquetry {
namespace {

int area_of(const std::vector<Block>& blocks) {
  int sum = 0;
  for (const Block& block : blocks) sum += block.box().area();
  return sum;
}

TEST(CoarseBlocks, OfASquareAreTheLargest) {
  const std::vector<Block> blocks = coarse_blocks(cv::Mat1b(50, 50, std::uint8_t{255}));
  EXPECT_EQ(blocks.size(), 9u);
  for (const Block& block : blocks) EXPECT_EQ(block.side, 16);
}

TEST(CoarseBlocks, AreInsideTheMaskAndApart) {
  int mixed = 0;
  for (int seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed, RngPurpose::kShapes);
    const cv::Size size(static_cast<int>(rng.uniform(5, 70)), static_cast<int>(rng.uniform(5, 70)));
    cv::Mat1b left = odd_patch(rng, {{3, 4}, size}).mask.clone();
    const std::vector<Block> blocks = coarse_blocks(left);
    for (const Block& block : blocks) {
      const cv::Rect box = block.box();
      ASSERT_EQ(box & cv::Rect({0, 0}, left.size()), box);
      EXPECT_EQ(cv::countNonZero(left(box)), box.area());
      left(box).setTo(0);
    }
    EXPECT_TRUE(std::is_sorted(blocks.begin(), blocks.end(),
                               [](const Block& a, const Block& b) { return a.box().br().y < b.box().br().y; }));
    const auto has = [&](int side) {
      return std::any_of(blocks.begin(), blocks.end(), [&](const Block& block) { return block.side == side; });
    };
    mixed += has(16) && has(8);
  }
  EXPECT_GT(mixed, 10);
}

// A disc holds few large squares: smaller ones fill what they leave.
TEST(CoarseBlocks, CoverMostOfADisc) {
  cv::Mat1b disc(60, 60, std::uint8_t{0});
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x)
      if (std::hypot(x - 29.5, y - 29.5) < 30) disc(y, x) = 255;
  EXPECT_GT(area_of(coarse_blocks(disc)), 0.65 * cv::countNonZero(disc));
}

}  // namespace
}  // namespace tessera::parquetry
