#include "tessera/geometry/narrow.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tessera/base/portable_math.h"
#include "tessera/base/rng.h"

namespace tessera {
namespace {

Ring turned(Ring ring, double angle) {
  const SinCos turn = sin_cos(angle);
  for (Point& p : ring) p = {turn.cos * p.x - turn.sin * p.y, turn.sin * p.x + turn.cos * p.y};
  return ring;
}

// Two squares of side 20, a bar of length 10 and width w between them about the origin.
Ring dumbbell(double w) {
  return {{-25, -10}, {-5, -10}, {-5, -w / 2}, {5, -w / 2}, {5, -10}, {25, -10},
          {25, 10},   {5, 10},   {5, w / 2},   {-5, w / 2}, {-5, 10}, {-25, 10}};
}

TEST(Narrow, ANecksWidthAndPlace) {
  constexpr double kPrecision = 0.2;
  for (int seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed, RngPurpose::kShapes);
    const double w = rng.uniform(1, 8), angle = rng.uniform(0, 6);
    const Polygon polygon{turned(dumbbell(w), angle), {}};
    const Neck neck = narrowest_neck(polygon, 10, kPrecision);
    EXPECT_NEAR(neck.width, w, 2 * kPrecision);
    EXPECT_LT(length(neck.at), 6);
    EXPECT_TRUE(std::isinf(narrowest_neck(polygon, w - 3 * kPrecision, kPrecision).width));
  }
}

TEST(Narrow, RingsAndConvexShapesHaveNoNeck) {
  const Polygon square{{{0, 0}, {40, 0}, {40, 40}, {0, 40}}, {}};
  EXPECT_TRUE(std::isinf(narrowest_neck(square, 100, 0.2).width));
  // Taken apart by a cut at its thinnest place, a ring still is one piece.
  Polygon ring = square;
  ring.holes = {{{2, 10}, {2, 30}, {30, 30}, {30, 10}}};
  EXPECT_TRUE(std::isinf(narrowest_neck(ring, 6, 0.2).width));
}

// A disc misses r^2 (cot(a/2) - (pi - a)/2) of a corner of angle a.
TEST(Narrow, CornersAndTails) {
  for (const double angle : {kPi / 6, kPi / 4, kPi / 3, kPi / 2}) {
    const SinCos way = sin_cos(angle), half = sin_cos(angle / 2);
    const Polygon wedge{{{0, 0}, {60, 0}, {60 * way.cos, 60 * way.sin}}, {}};
    const double r = 2, closed = r * r * (half.cos / half.sin - (kPi - angle) / 2);
    if (angle > kPi / 3 + 0.01) continue;  // another corner is sharper
    const double sharpest = angle;
    EXPECT_NEAR(largest_thin_part(wedge, 2 * r, 0.05).area, closed, 0.15 * closed) << sharpest;
  }
  Polygon tailed{{{0, 0}, {20, 0}, {20, 9}, {40, 9}, {40, 11}, {20, 11}, {20, 20}, {0, 20}}, {}};
  const ThinPart tail = largest_thin_part(tailed, 5, 0.1);
  EXPECT_NEAR(tail.area, 2 * 19.5, 3);
  EXPECT_NEAR(tail.at.x, 30, 1.5);
  EXPECT_NEAR(tail.at.y, 10, 0.5);
  EXPECT_NEAR(largest_thin_part({{{0, 0}, {9, 0}, {9, 3}, {0, 3}}, {}}, 5, 0.1).area, 27, 0.5);
}

}  // namespace
}  // namespace tessera
