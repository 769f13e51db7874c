#include "tessera/voronoi/site.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tessera/base/portable_math.h"
#include "tessera/base/rng.h"

namespace tessera {
namespace {

Site site_of(double x, double y, double angle, float extent_u, float extent_v) {
  Site site;
  site.x = x;
  site.y = y;
  site.angle = angle;
  site.extent_u = extent_u;
  site.extent_v = extent_v;
  return site;
}

TEST(SiteDistance, ClosedForms) {
  const SiteDistance rectangle(site_of(10, 20, 0, 3, 1), Metric::kFrustum);
  EXPECT_DOUBLE_EQ(rectangle.at(10, 20).distance, -1);  // the nearer border
  EXPECT_DOUBLE_EQ(rectangle.at(12.5, 20).distance, -0.5);
  EXPECT_DOUBLE_EQ(rectangle.at(13, 20).distance, 0);
  EXPECT_DOUBLE_EQ(rectangle.at(15, 20.5).distance, 2);
  EXPECT_DOUBLE_EQ(rectangle.at(16, 25).distance, 5);  // round at the corner: 3, 4
  EXPECT_DOUBLE_EQ(SiteDistance(site_of(1, 2, 1.1, 0, 0), Metric::kFrustum).at(4, 6).distance, 5);  // Euclid
}

TEST(SiteDistance, TurnsWithItsSite) {
  Rng rng(1, RngPurpose::kShapes);
  const SiteDistance straight(site_of(0, 0, 0, 2, 0.5f), Metric::kFrustum);
  for (int i = 0; i < 1000; ++i) {
    const double angle = rng.uniform(-4, 4), u = rng.uniform(-6, 6), v = rng.uniform(-6, 6);
    const SinCos turn = sin_cos(angle);
    const SiteDistance turned(site_of(3, -5, angle, 2, 0.5f), Metric::kFrustum);
    const double x = 3 + turn.cos * u - turn.sin * v, y = -5 + turn.sin * u + turn.cos * v;
    ASSERT_NEAR(turned.at(x, y).distance, straight.at(u, v).distance, 1e-12);
  }
}

TEST(SiteDistance, SlopeIsTheGradient) {
  Rng rng(2, RngPurpose::kShapes);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 2000; ++i) {
    const SiteDistance frame(site_of(0, 0, rng.uniform(-4, 4), static_cast<float>(rng.uniform(0, 3)),
                                     static_cast<float>(rng.uniform(0, 3))),
                             Metric::kFrustum);
    const double x = rng.uniform(-8, 8), y = rng.uniform(-8, 8);
    const auto here = frame.at(x, y);
    const double dx = (frame.at(x + kStep, y).distance - frame.at(x - kStep, y).distance) / (2 * kStep);
    const double dy = (frame.at(x, y + kStep).distance - frame.at(x, y - kStep).distance) / (2 * kStep);
    ASSERT_NEAR(std::hypot(here.slope_x, here.slope_y), 1, 1e-9);
    ASSERT_NEAR(here.slope_x, dx, 1e-4);
    ASSERT_NEAR(here.slope_y, dy, 1e-4);
  }
}

}  // namespace
}  // namespace tessera
