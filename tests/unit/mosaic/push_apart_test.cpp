// Overlapping squares moved apart.
#include "tessera/mosaic/push_apart.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tessera/base/portable_math.h"
#include "tessera/base/rng.h"
#include "tessera/geometry/polygon.h"

namespace tessera::mosaic {
namespace {

Site square_at(double x, double y, double angle) {
  return {.x = x, .y = y, .angle = angle, .extent_u = 5, .extent_v = 5};
}

Ring ring_of(const Site& site, double delta) {
  const SinCos turn = sin_cos(site.angle);
  const Point c{site.x, site.y}, u = (delta * site.extent_u) * Point{turn.cos, turn.sin},
                                 v = (delta * site.extent_v) * Point{-turn.sin, turn.cos};
  return {c - u - v, c + u - v, c + u + v, c - u + v};
}

double overlap(const Sites& sites, double delta) {
  double sum = 0;
  for (std::size_t i = 0; i < sites.size(); ++i)
    for (std::size_t k = i + 1; k < sites.size(); ++k)
      sum += std::fabs(signed_area(clip_convex(ring_of(sites[i], delta), ring_of(sites[k], delta))));
  return sum;
}

TEST(MosaicPushApart, APairGoesApartTheShortestWay) {
  Sites sites = {square_at(50, 50, 0), square_at(56, 52, 0)};
  push_apart(sites, 0.8, Torus{{100, 100}});
  EXPECT_NEAR(sites[0].x, 49, 1e-9);  // 8 wide each, 6 apart
  EXPECT_NEAR(sites[1].x, 57, 1e-9);
  EXPECT_EQ(sites[0].y, 50);
  EXPECT_EQ(sites[1].y, 52);
}

TEST(MosaicPushApart, TilesWithRoomStayWhereTheyAre) {
  const Sites before = {square_at(50, 50, 0.3), square_at(61, 50, 0.3), square_at(20, 20, 0)};
  Sites sites = before;
  push_apart(sites, 0.8, Torus{{100, 100}});
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_EQ(sites[i].x, before[i].x);
    EXPECT_EQ(sites[i].y, before[i].y);
  }
}

TEST(MosaicPushApart, ACrowdOfTurnedSquaresHardlyOverlapsAfterwards) {
  Rng rng(3, RngPurpose::kSites);
  Sites sites;
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 12; ++x)
      sites.push_back(square_at(5 + 10 * x + rng.uniform(-1.5, 1.5), 5 + 10 * y + rng.uniform(-1.5, 1.5),
                                rng.uniform(-0.4, 0.4)));
  const double all = 144 * 64;
  ASSERT_GT(overlap(sites, 0.8), 0.005 * all);
  push_apart(sites, 0.8, Torus{{120, 120}});
  EXPECT_LT(overlap(sites, 0.8), 0.0005 * all);
  for (const Site& site : sites) EXPECT_TRUE(site.x >= 0 && site.y >= 0 && site.x <= 120 && site.y <= 120);
}

TEST(MosaicPushApart, OnePlaceOrNoRoomIsNoTrouble) {
  Sites sites(5, square_at(3, 3, 0));
  push_apart(sites, 3, Torus{{6, 6}});
  for (const Site& site : sites) EXPECT_TRUE(std::isfinite(site.x) && std::isfinite(site.y));
}

}  // namespace
}  // namespace tessera::mosaic
