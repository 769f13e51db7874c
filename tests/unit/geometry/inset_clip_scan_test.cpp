// Rings moved inwards, cut, and the pixels under them.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tessera/base/rng.h"
#include "tessera/geometry/polygon.h"
#include "tessera/geometry/scan.h"

namespace tessera {
namespace {

Ring random_convex(Rng& rng, double radius) {
  Ring ring;
  const int n = 3 + static_cast<int>(rng.bits() % 5);
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979 * (i + rng.uniform(0, 0.6)) / n;
    ring.push_back({20 + radius * std::cos(angle), 20 + radius * std::sin(angle)});
  }
  return ring;
}

double distance_to_line(Point p, Point a, Point b) { return cross(b - a, p - a) / length(b - a); }

TEST(Inset, OfASquareIsASmallerSquare) {
  EXPECT_EQ(inset({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, 1), (Ring{{1, 1}, {9, 1}, {9, 9}, {1, 9}}));
}

TEST(Inset, KeepsEverySideParallelAtThatDistance) {
  Rng rng(1, RngPurpose::kShapes);
  for (int i = 0; i < 2000; ++i) {
    const Ring ring = random_convex(rng, 10);
    if (signed_area(ring) < 60) continue;
    const Ring smaller = inset(ring, 0.5);
    ASSERT_EQ(smaller.size(), ring.size());
    ASSERT_TRUE(is_simple(smaller));
    ASSERT_LT(signed_area(smaller), signed_area(ring));
    const double first = distance_to_line(smaller[0], ring[0], ring[1]);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point a = ring[k], b = ring[(k + 1) % ring.size()];
      ASSERT_NEAR(distance_to_line(smaller[k], a, b), first, 1e-9);
      ASSERT_NEAR(distance_to_line(smaller[(k + 1) % ring.size()], a, b), first, 1e-9);
    }
  }
}

TEST(Inset, OfWhatIsTooNarrowIsLess) {
  const Ring narrow = {{0, 0}, {10, 0}, {10, 1}, {0, 1}};
  const Ring smaller = inset(narrow, 0.8);
  EXPECT_GT(signed_area(smaller), 0);
  EXPECT_LT(signed_area(smaller), 10);
  EXPECT_EQ(inset(narrow, 0), narrow);
  EXPECT_EQ(inset({{0, 0}, {1, 0}}, 1), (Ring{{0, 0}, {1, 0}}));
}

TEST(ClipConvex, AreasOfBothHalvesAddUp) {
  Rng rng(2, RngPurpose::kShapes);
  for (int i = 0; i < 1000; ++i) {
    const Ring ring = random_convex(rng, 10);
    const double x = rng.uniform(5, 35);
    const Ring left = clip_convex({{0, 0}, {x, 0}, {x, 40}, {0, 40}}, ring);
    const Ring right = clip_convex({{x, 0}, {40, 0}, {40, 40}, {x, 40}}, ring);
    ASSERT_NEAR(signed_area(left) + signed_area(right), signed_area(ring), 1e-9);
  }
  EXPECT_TRUE(clip_convex({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{5, 5}, {6, 5}, {6, 6}}).empty());
}

TEST(EachRun, TakesEveryPixelWhoseCentreIsInside) {
  Rng rng(3, RngPurpose::kShapes);
  for (int i = 0; i < 300; ++i) {
    const Ring ring = random_convex(rng, rng.uniform(0.5, 25));  // some reach beyond the picture
    std::map<std::pair<int, int>, int> hits;
    each_run(ring, 36, 34, [&](int y, int begin, int end) {
      ASSERT_TRUE(y >= 0 && y < 34 && begin >= 0 && end <= 36);
      for (int x = begin; x < end; ++x) ++hits[{x, y}];
    });
    for (int y = 0; y < 34; ++y)
      for (int x = 0; x < 36; ++x) {
        bool inside = true;
        for (std::size_t k = 0; k < ring.size(); ++k)
          inside &= distance_to_line({x + 0.5, y + 0.5}, ring[k], ring[(k + 1) % ring.size()]) >= 0;
        ASSERT_EQ((hits[{x, y}]), inside ? 1 : 0) << x << ' ' << y;
      }
  }
}

}  // namespace
}  // namespace tessera
