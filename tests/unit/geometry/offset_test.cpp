#include "tessera/geometry/offset.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tessera/base/portable_math.h"
#include "tessera/base/rng.h"
#include "tessera/geometry/inscribed.h"

namespace tessera {
namespace {

double distance_to_ring(Point p, const Ring& ring) {
  double nearest = 1e300;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], way = ring[i + 1 < ring.size() ? i + 1 : 0] - a;
    const double along = std::min(1.0, std::max(0.0, dot(p - a, way) / dot(way, way)));
    nearest = std::min(nearest, length(p - a - along * way));
  }
  return nearest;
}

Ring turned_square(double side, double degrees) {
  const SinCos turn = sin_cos(degrees * kPi / 180);
  Ring ring;
  for (const Point p : {Point{0, 0}, Point{side, 0}, Point{side, side}, Point{0, side}})
    ring.push_back({50 + turn.cos * p.x - turn.sin * p.y, 50 + turn.sin * p.x + turn.cos * p.y});
  return ring;
}

// A square with sides as wavy as puzzles'.
Ring wavy_square(std::uint64_t seed) {
  Rng rng(seed, RngPurpose::kShapes);
  const int parts = 2 + static_cast<int>(rng.bits() % 10);
  const double side = rng.uniform(6, 20);
  const Ring square = turned_square(side, rng.uniform(0, 360));
  Ring ring;
  for (std::size_t i = 0; i < 4; ++i)
    for (int k = 0; k < parts; ++k) {
      const double wobble = k > 0 ? 0.25 * side / parts : 0;
      const Point on_side = square[i] + (1.0 * k / parts) * (square[(i + 1) % 4] - square[i]);
      ring.push_back(on_side + Point{rng.uniform(-wobble, wobble), rng.uniform(-wobble, wobble)});
    }
  return ring;
}

TEST(Grown, ASquareIsALargerSquare) {
  for (const double degrees : {0.0, 24.0, 45.0, 168.0})
    for (const double distance : {0.05, 0.1, 2.5}) {
      const Polygon larger = grown({turned_square(14, degrees), {}}, distance);
      ASSERT_EQ(larger.outer.size(), 4U) << degrees;
      EXPECT_NEAR(signed_area(larger.outer), std::pow(14 + 2 * distance, 2), 0.02);
    }
}

TEST(Grown, NothingStaysAsItIs) {
  const Ring square = turned_square(3, 10);
  EXPECT_EQ(grown({square, {}}, 0).outer, square);
}

TEST(Grown, HolesShrinkAndClose) {
  const Ring square = turned_square(20, 0);
  const auto hole = [](double side) {
    return Ring{{55, 55}, {55, 55 + side}, {55 + side, 55 + side}, {55 + side, 55}};
  };
  const Polygon larger = grown({square, {hole(4)}}, 1);
  ASSERT_EQ(larger.holes.size(), 1U);
  EXPECT_NEAR(signed_area(larger.holes.front()), -4, 0.01);
  EXPECT_TRUE(grown({square, {hole(1.5)}}, 1).holes.empty());
}

// Every side of the result is `distance` from the outline, none nearer, and all of it is around it.
TEST(Grown, KeepsItsDistanceFromWavyOutlines) {
  int seen = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const Ring ring = wavy_square(seed);
    if (!is_simple(ring)) continue;
    ++seen;
    const Polygon larger = grown({ring, {}}, 0.1);
    ASSERT_TRUE(is_simple(larger.outer)) << seed;
    ASSERT_TRUE(larger.holes.empty()) << seed;
    EXPECT_GT(signed_area(larger.outer), signed_area(ring) + 0.08 * perimeter(ring)) << seed;
    for (const Point p : ring) EXPECT_GT(distance_to_ring(p, larger.outer), 0.0998) << seed;
    for (const Point p : larger.outer) EXPECT_GT(distance_to_ring(p, ring), 0.0998) << seed;
  }
  EXPECT_GT(seen, 300);
}

TEST(LargestInscribed, ClosedForms) {
  const Circle in_square = largest_inscribed({turned_square(10, 30), {}}, 0.001);
  EXPECT_NEAR(in_square.radius, 5, 0.001);
  const Circle in_triangle = largest_inscribed({{{0, 0}, {12, 0}, {0, 5}}, {}}, 0.001);
  EXPECT_NEAR(in_triangle.radius, 2, 0.001);
  EXPECT_NEAR(in_triangle.centre.x, 2, 0.01);
  EXPECT_NEAR(in_triangle.centre.y, 2, 0.01);
  // An L whose centroid is no good place.
  EXPECT_NEAR(largest_inscribed({{{0, 0}, {30, 0}, {30, 4}, {4, 4}, {4, 30}, {0, 30}}, {}}, 0.001).radius,
              4 * 2 / (2 + std::sqrt(2.0)), 0.002);
  // A hole takes the middle.
  const Ring hole = {{4, 4}, {4, 6}, {6, 6}, {6, 4}};
  const Circle beside = largest_inscribed({{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {hole}}, 0.001);
  EXPECT_LT(beside.radius, 3);
  EXPECT_GT(beside.radius, 2);
}

TEST(LargestInscribed, IsInsideAndAsDeepAsItSays) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Ring ring = wavy_square(seed);
    if (!is_simple(ring)) continue;
    const Circle circle = largest_inscribed({ring, {}}, 0.01);
    EXPECT_NEAR(distance_to_ring(circle.centre, ring), circle.radius, 1e-9);
    // No place of a fine grid is deeper by more than the precision.
    for (double y = 20; y < 80; y += 0.5)
      for (double x = 20; x < 80; x += 0.5) {
        const Ring inside = clip_convex({{x, y}, {x + 1e-3, y}, {x + 1e-3, y + 1e-3}, {x, y + 1e-3}}, ring);
        if (inside.empty() || signed_area(inside) < 5e-7) continue;
        EXPECT_LT(distance_to_ring({x, y}, ring), circle.radius + 0.012) << seed;
      }
  }
}

}  // namespace
}  // namespace tessera
