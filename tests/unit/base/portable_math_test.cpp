#include "tessera/base/portable_math.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tessera/base/rng.h"

namespace tessera {
namespace {

TEST(PortableMath, SineAndCosineAreWithinTheStatedError) {
  Rng rng(1, RngPurpose::kNoise);
  for (int i = 0; i < 100000; ++i) {
    const double reach = i % 2 == 0 ? 10 : 1e4;
    const double angle = rng.uniform(-reach, reach);
    const SinCos turn = sin_cos(angle);
    ASSERT_NEAR(turn.sin, std::sin(static_cast<long double>(angle)), 1e-13) << angle;
    ASSERT_NEAR(turn.cos, std::cos(static_cast<long double>(angle)), 1e-13) << angle;
  }
}

TEST(PortableMath, SineAndCosineAtTheEdgesOfOctants) {
  for (int k = -12800; k <= 12800; ++k) {
    for (const double off : {-1e-9, 0.0, 1e-9}) {
      const double angle = std::fmin(1e4, std::fmax(-1e4, k * kPi / 4 + off));
      ASSERT_NEAR(sin_cos(angle).sin, std::sin(angle), 1e-13) << angle;
      ASSERT_NEAR(sin_cos(angle).cos, std::cos(angle), 1e-13) << angle;
    }
  }
  EXPECT_EQ(sin_cos(0).sin, 0);
  EXPECT_EQ(sin_cos(0).cos, 1);
}

TEST(PortableMath, SineIsOddAndCosineEven) {
  for (double angle = 0; angle < 20; angle += 0.37) {
    EXPECT_EQ(sin_cos(-angle).sin, -sin_cos(angle).sin);
    EXPECT_EQ(sin_cos(-angle).cos, sin_cos(angle).cos);
  }
}

TEST(PortableMath, ArctangentIsWithinTheStatedError) {
  Rng rng(2, RngPurpose::kNoise);
  for (int i = 0; i < 100000; ++i) {
    const double size = std::pow(10, rng.uniform(-12, 12));
    const double y = size * rng.uniform(-1, 1), x = i % 3 == 0 ? rng.uniform(-1, 1) : size * rng.uniform(-1, 1);
    const double angle = atan2_portable(y, x);
    ASSERT_NEAR(angle, std::atan2(y, x), 1e-12) << y << ", " << x;
    ASSERT_GE(angle, -kPi);
    ASSERT_LE(angle, kPi);
  }
}

TEST(PortableMath, ArctangentOnAxesAndDiagonals) {
  EXPECT_EQ(atan2_portable(0, 0), 0);
  EXPECT_EQ(atan2_portable(-0.0, 0.0), 0);
  EXPECT_EQ(atan2_portable(0, 2), 0);
  EXPECT_EQ(atan2_portable(0, -2), kPi);
  EXPECT_EQ(atan2_portable(-0.0, -2), kPi);  // (-pi, pi]
  EXPECT_NEAR(atan2_portable(3, 0), kPi / 2, 1e-12);
  EXPECT_NEAR(atan2_portable(-3, 0), -kPi / 2, 1e-12);
  for (int octant = 1; octant < 8; octant += 2) {
    const double angle = (octant - 4) * kPi / 4;
    EXPECT_NEAR(atan2_portable(std::sin(angle), std::cos(angle)), angle, 1e-12);
  }
}

TEST(PortableMath, ArctangentUndoesSineAndCosine) {
  for (double angle = -3.14; angle < 3.14; angle += 0.013) {
    const SinCos turn = sin_cos(angle);
    EXPECT_NEAR(atan2_portable(7 * turn.sin, 7 * turn.cos), angle, 2e-12);
  }
}

TEST(PortableMath, PositionsSnapToTheNearestMultiple) {
  Rng rng(3, RngPurpose::kNoise);
  for (int i = 0; i < 10000; ++i) {
    const double v = rng.uniform(-1e5, 1e5), snapped = snap_position(v);
    ASSERT_LE(std::fabs(snapped - v), 0.5 / 1024);
    ASSERT_EQ(snapped * 1024, std::floor(snapped * 1024));
    ASSERT_EQ(snap_position(snapped), snapped);
  }
  EXPECT_EQ(snap_position(3.0), 3.0);
}

TEST(PortableMath, AnglesSnapToTheNearestMultiple) {
  constexpr double kStep = 2 * kPi / 65536;
  Rng rng(4, RngPurpose::kNoise);
  for (int i = 0; i < 10000; ++i) {
    const double v = rng.uniform(-10, 10), snapped = snap_angle(v);
    ASSERT_LE(std::fabs(snapped - v), 0.5 * kStep + 1e-12);
    ASSERT_NEAR(snapped / kStep, std::round(snapped / kStep), 1e-6);
    ASSERT_EQ(snap_angle(snapped), snapped);
  }
  EXPECT_EQ(snap_angle(0), 0);
  EXPECT_NEAR(snap_angle(kPi), kPi, 1e-15);
}

}  // namespace
}  // namespace tessera
