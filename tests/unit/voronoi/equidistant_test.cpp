#include "tessera/voronoi/equidistant.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tessera/base/rng.h"

namespace tessera {
namespace {

Site site_at(double x, double y, double angle, float extent) {
  Site site;
  site.x = x;
  site.y = y;
  site.angle = angle;
  site.extent_u = site.extent_v = extent;
  return site;
}

TEST(MakeEquidistant, EndsWhereAllThreeAreEquallyFarOrLeavesThePoint) {
  Rng rng(1, RngPurpose::kShapes);
  int moved = 0;
  for (const Metric metric : {Metric::kFrustum, Metric::kChebyshev}) {
    for (int i = 0; i < 2000; ++i) {
      const auto random_site = [&](double x, double y) {
        return SiteDistance(site_at(x + rng.uniform(-1, 1), y + rng.uniform(-1, 1), rng.uniform(-1, 1),
                                    static_cast<float>(rng.uniform(1, 3))),
                            metric);
      };
      const SiteDistance a = random_site(0, 0), b = random_site(8, 1), c = random_site(4, 7);
      const Point begin{rng.uniform(2, 6), rng.uniform(1, 5)};
      Point p = begin;
      if (!make_equidistant(a, b, c, 2, p)) {
        EXPECT_EQ(p, begin);
        continue;
      }
      ++moved;
      const double d = a.at(p.x, p.y).distance;
      EXPECT_LE(length(p - begin), 2 + 1e-9);
      EXPECT_NEAR(b.at(p.x, p.y).distance, d, 0.05);
      EXPECT_NEAR(c.at(p.x, p.y).distance, d, 0.05);
    }
  }
  EXPECT_GT(moved, 1000);
}

TEST(MakeEquidistantAlong, StaysOnTheLine) {
  const SiteDistance a(site_at(0, 0, 0, 1), Metric::kChebyshev), b(site_at(10, 0, 0, 1), Metric::kChebyshev);
  Point p{4, 1};
  ASSERT_TRUE(make_equidistant_along(a, b, {1, 0}, 2, p));
  EXPECT_NEAR(p.x, 5, 1e-9);
  EXPECT_EQ(p.y, 1);
  p = {1, 1};
  EXPECT_FALSE(make_equidistant_along(a, b, {1, 0}, 2, p));
  EXPECT_EQ(p, (Point{1, 1}));
}

}  // namespace
}  // namespace tessera
