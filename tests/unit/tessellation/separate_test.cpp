// Outlines in the precision of files.
#include "tessera/tessellation/separate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera {
namespace {

using testing::ElementsAre;

TEST(RoundedOutline, CoordinatesAreMultiples) {
  const Ring ring = rounded_outline({{0.0004, 0}, {10.0006, 0}, {10, 9.9996}, {0, 10}}, 1000);
  EXPECT_THAT(ring, ElementsAre(Point{0, 0}, Point{10.001, 0}, Point{10, 10}, Point{0, 10}));
}

TEST(RoundedOutline, ASpikeIsLeftOut) {
  const Ring thin = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {-0.0002, 14}, {0, 5}};
  ASSERT_TRUE(is_simple(thin));
  const Ring ring = rounded_outline(thin, 1000);
  EXPECT_TRUE(is_simple(ring));
  EXPECT_GE(ring.size(), 4u);
  EXPECT_NEAR(signed_area(ring), signed_area(thin), 0.01);
}

TEST(RoundedOutline, CornersThatComeTogetherAreOneButFourRemain) {
  const Ring ring = rounded_outline({{0, 0}, {10, 0}, {10.0001, 0.0001}, {0, 10}}, 1000);
  EXPECT_TRUE(ring.size() == 4) << ring.size();
  EXPECT_NEAR(signed_area(ring), 50, 0.01);
}

TEST(RoundedOutline, WhatIsTooSmallIsNothing) {
  EXPECT_TRUE(rounded_outline({{0, 0}, {0.0001, 0}, {0.0001, 0.0001}, {0, 0.0001}}, 1000).empty());
  EXPECT_TRUE(rounded_outline({}, 1000).empty());
}

}  // namespace
}  // namespace tessera
