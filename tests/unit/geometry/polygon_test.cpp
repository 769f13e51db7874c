#include "tessera/geometry/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tessera/base/rng.h"

namespace tessera {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

Point turned(Point p, double degrees) {
  const double c = std::cos(degrees * kDegree), s = std::sin(degrees * kDegree);
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}

Ring rectangle(Point centre, double width, double height, double degrees) {
  Ring ring;
  for (const Point corner : {Point{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    ring.push_back(centre + turned({corner.x * width / 2, corner.y * height / 2}, degrees));
  return ring;
}

// Star-shaped about the origin, so simple; radii between 0.3 and 1.
Ring star(Rng& rng, int vertices) {
  Ring ring;
  for (int i = 0; i < vertices; ++i) ring.push_back(rng.uniform(0.3, 1) * turned({1, 0}, 360.0 * i / vertices));
  return ring;
}

Ring reversed(Ring ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

// Between two directions of a line, in degrees, 0..90.
double angle_between(double a, double b) {
  const double d = std::fmod(std::abs(a - b), 180);
  return std::min(d, 180 - d);
}

TEST(Polygon, ClockwiseOnTheScreenIsPositive) {
  const Ring square = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};  // right, down, left
  EXPECT_EQ(signed_area(square), 4);
  EXPECT_EQ(signed_area(reversed(square)), -4);
  EXPECT_EQ(perimeter(square), 8);
}

TEST(Polygon, RectanglesAtManyAngles) {
  const Point centre{1234.5, -987.25};
  for (int degrees = 0; degrees < 180; ++degrees) {
    const Ring ring = rectangle(centre, 10, 3, degrees);
    EXPECT_NEAR(signed_area(ring), 30, 1e-9);
    EXPECT_NEAR(perimeter(ring), 26, 1e-9);
    EXPECT_NEAR(centroid(ring).x, centre.x, 1e-9);
    EXPECT_NEAR(centroid(ring).y, centre.y, 1e-9);
    EXPECT_TRUE(is_convex(ring));
    EXPECT_TRUE(is_simple(ring));
    for (const Ring& same : {ring, reversed(ring)}) {
      const double orientation = orientation_deg(same);
      EXPECT_GE(orientation, 0);
      EXPECT_LT(orientation, 180);
      EXPECT_NEAR(angle_between(orientation, degrees), 0, 1e-6) << degrees;
    }
  }
}

TEST(Polygon, SquaresPointIntoTheFirstQuadrant) {
  for (int degrees = 0; degrees < 360; degrees += 5) {
    const double orientation = orientation_deg(rectangle({5, 5}, 4, 4, degrees));
    EXPECT_GE(orientation, 0);
    EXPECT_LT(orientation, 90);
    EXPECT_NEAR(std::abs(std::sin(2 * (orientation - degrees) * kDegree)), 0, 1e-6) << degrees;
  }
}

TEST(Polygon, OrientationOfLinesAndPoints) {
  EXPECT_EQ(orientation_deg({}), 0);
  EXPECT_EQ(orientation_deg({{3, 4}}), 0);
  EXPECT_EQ(orientation_deg({{3, 4}, {3, 4}, {3, 4}}), 0);
  EXPECT_NEAR(orientation_deg({{0, 0}, {1, 1}, {5, 5}, {2, 2}}), 45, 1e-9);
  EXPECT_NEAR(orientation_deg({{0, 0}, {0, 7}}), 90, 1e-9);
}

// The least rectangle is searched directly: by brute force over all directions between two vertices.
TEST(Polygon, OrientationHasTheLeastRectangleOverManySeeds) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    Rng rng(seed, RngPurpose::kShapes);
    const Ring ring = star(rng, 3 + static_cast<int>(seed % 12));
    const auto box_area = [&ring](Point along) {
      double low_u = 1e9, high_u = -1e9, low_v = 1e9, high_v = -1e9;
      for (const Point p : ring) {
        const double u = dot(along, p), v = cross(along, p);
        low_u = std::min(low_u, u), high_u = std::max(high_u, u);
        low_v = std::min(low_v, v), high_v = std::max(high_v, v);
      }
      EXPECT_GE(high_u - low_u, 0);
      return (high_u - low_u) * (high_v - low_v);
    };
    double least = 1e9;
    for (const Point a : ring)
      for (const Point b : ring)
        if (!(a == b)) least = std::min(least, box_area(1 / length(b - a) * (b - a)));
    EXPECT_NEAR(box_area(turned({1, 0}, orientation_deg(ring))), least, 1e-9) << "seed " << seed;
  }
}

TEST(Polygon, RegularPolygons) {
  for (int n = 3; n <= 40; ++n) {
    Ring ring;
    for (int i = 0; i < n; ++i) ring.push_back(Point{50, 60} + 7 * turned({1, 0}, 360.0 * i / n));
    EXPECT_NEAR(signed_area(ring), n / 2.0 * 49 * std::sin(360 * kDegree / n), 1e-9);
    EXPECT_NEAR(perimeter(ring), n * 14 * std::sin(180 * kDegree / n), 1e-9);
    EXPECT_NEAR(centroid(ring).x, 50, 1e-9);
    EXPECT_NEAR(centroid(ring).y, 60, 1e-9);
    EXPECT_TRUE(is_convex(ring));
    EXPECT_TRUE(is_simple(ring));
  }
}

TEST(Polygon, HolesAreTakenFromTheAreaWhicheverWayTheyTurn) {
  const Ring outer = {{0, 0}, {10, 0}, {10, 10}, {0, 10}}, hole = {{2, 2}, {4, 2}, {4, 5}, {2, 5}};
  EXPECT_EQ(area({outer, {}}), 100);
  EXPECT_EQ(area({outer, {hole}}), 94);
  EXPECT_EQ(area({reversed(outer), {hole, reversed(hole)}}), 88);
  EXPECT_EQ(area({hole, {outer}}), 0);
}

TEST(Polygon, CentroidOfAFlatRingIsTheMeanOfItsVertices) {
  EXPECT_EQ(centroid({}), (Point{0, 0}));
  EXPECT_EQ(centroid({{3, 4}}), (Point{3, 4}));
  EXPECT_EQ(centroid({{0, 0}, {2, 2}, {4, 4}}), (Point{2, 2}));
  const Point sliver = centroid({{1000, 1000}, {1001, 1000}, {1002, 1000 + 1e-13}});
  EXPECT_NEAR(sliver.x, 1001, 1e-9);
  EXPECT_NEAR(sliver.y, 1000, 1e-9);
}

TEST(Polygon, AreaAndCentroidMoveWithThePolygonOverManySeeds) {
  for (unsigned seed = 1; seed <= 100; ++seed) {
    Rng rng(seed, RngPurpose::kShapes);
    const Ring ring = star(rng, 3 + static_cast<int>(seed % 17));
    const Point shift{rng.uniform(-1e5, 1e5), rng.uniform(-1e5, 1e5)};
    const double degrees = rng.uniform(0, 360);
    Ring moved;
    for (const Point p : ring) moved.push_back(shift + turned(p, degrees));
    EXPECT_NEAR(signed_area(moved), signed_area(ring), 1e-9);
    EXPECT_NEAR(signed_area(reversed(ring)), -signed_area(ring), 1e-12);
    EXPECT_NEAR(length(centroid(moved) - (shift + turned(centroid(ring), degrees))), 0, 1e-8);
    EXPECT_NEAR(length(centroid(reversed(ring)) - centroid(ring)), 0, 1e-12);
  }
}

TEST(Polygon, AreaAndCentroidAddUpWhenCutInTwo) {
  for (unsigned seed = 1; seed <= 100; ++seed) {
    Rng rng(seed, RngPurpose::kShapes);
    const Ring ring = star(rng, 8);
    Ring first(ring.begin(), ring.begin() + 5), second(ring.begin() + 4, ring.end());  // cut through the origin
    first.push_back({0, 0});
    second.push_back(ring[0]);
    second.push_back({0, 0});
    const double a = signed_area(first), b = signed_area(second);
    EXPECT_NEAR(a + b, signed_area(ring), 1e-12);
    const Point both = 1 / (a + b) * (a * centroid(first) + b * centroid(second));
    EXPECT_NEAR(length(both - centroid(ring)), 0, 1e-12);
  }
}

TEST(Polygon, ConvexMeansNoTurnAgainstTheSense) {
  const Ring dented = {{0, 0}, {4, 0}, {4, 4}, {2, 3.9}, {0, 4}};
  EXPECT_FALSE(is_convex(dented));
  EXPECT_FALSE(is_convex(reversed(dented)));
  EXPECT_TRUE(is_convex(dented, 0.2));                               // the dent turns by about 6 degrees
  EXPECT_TRUE(is_convex({{0, 0}, {2, 0}, {4, 0}, {4, 4}, {0, 4}}));  // a flat corner
  EXPECT_TRUE(is_convex({{0, 0}, {4, 0}, {4, 0}, {4, 4}, {0, 4}}));  // a repeated one
}

TEST(Polygon, SimpleRingsAndRingsThatAreNot) {
  EXPECT_TRUE(is_simple({{0, 0}, {4, 0}, {4, 4}}));
  EXPECT_TRUE(is_simple({{0, 0}, {2, 0}, {4, 0}, {4, 4}, {0, 4}}));           // a flat corner
  EXPECT_FALSE(is_simple({{0, 0}, {4, 0}}));                                  // no area
  EXPECT_FALSE(is_simple({{0, 0}, {4, 0}, {8, 0}}));                          // folded
  EXPECT_FALSE(is_simple({{0, 0}, {4, 4}, {4, 0}, {0, 4}}));                  // a bow
  EXPECT_FALSE(is_simple({{0, 0}, {4, 0}, {4, 0}, {4, 4}}));                  // a vertex twice
  EXPECT_FALSE(is_simple({{0, 0}, {8, 0}, {8, 8}, {4, 0}, {0, 8}}));          // a vertex on a side
  EXPECT_FALSE(is_simple({{0, 0}, {4, 0}, {4, 4}, {4, 8}, {4, 2}, {0, 4}}));  // a spike
  EXPECT_FALSE(is_simple({{0, 0}, {4, 0}, {2, 2}, {4, 4}, {0, 4}, {2, 2}}));  // pinched
  EXPECT_FALSE(is_simple({{0, 0}, {6, 0}, {6, 2}, {5, 0}, {1, 0}, {0, 2}}));  // sides on one another
}

// Where the lines through ab and cd meet, as parts of ab and of cd.
Point meeting(Point a, Point b, Point c, Point d) {
  const double across = cross(b - a, d - c);
  return {cross(c - a, d - c) / across, cross(c - a, b - a) / across};
}

bool any_sides_cross(const Ring& ring) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) {
      if (k == i || (k + 1) % n == i || (i + 1) % n == k) continue;
      const Point at = meeting(ring[i], ring[(i + 1) % n], ring[k], ring[(k + 1) % n]);
      if (at.x >= 0 && at.x <= 1 && at.y >= 0 && at.y <= 1) return true;
    }
  return false;
}

TEST(Polygon, StarsAreSimpleAndRandomRingsWhereNoSidesCross) {
  int simple = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    Rng rng(seed, RngPurpose::kShapes);
    const Ring round = star(rng, 3 + static_cast<int>(seed % 20));
    EXPECT_TRUE(is_simple(round)) << "seed " << seed;
    EXPECT_TRUE(is_simple(reversed(round))) << "seed " << seed;
    Ring ring;
    for (unsigned i = 0; i < 4 + seed % 4; ++i) ring.push_back({rng.uniform(), rng.uniform()});
    EXPECT_EQ(is_simple(ring), !any_sides_cross(ring)) << "seed " << seed;
    simple += is_simple(ring);
  }
  EXPECT_GT(simple, 40);  // both kinds came up
  EXPECT_LT(simple, 360);
}

}  // namespace
}  // namespace tessera
