// Rings shrunk for borders, against what of them is far enough from every side.
#include "tessera/patterns/shrink.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tessera/base/rng.h"
#include "tessera/patterns/run.h"

namespace tessera::patterns {
namespace {

Ring random_convex(Rng& rng) {
  Ring ring;
  const int n = 3 + static_cast<int>(rng.bits() % 9);
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979 * (i + rng.uniform(0, 0.9)) / n;
    ring.push_back({10 * std::cos(angle), 10 * std::sin(angle)});
  }
  return ring;
}

// What of a convex ring is `distance` from every side: cut by them all.
Ring cut_by_sides(const Ring& ring, double distance) {
  Ring rest = ring;
  for (std::size_t i = 0; i < ring.size() && !rest.empty(); ++i) {
    const Point a = ring[i], way = ring[(i + 1) % ring.size()] - a, along = (1 / length(way)) * way;
    const Point inwards{-along.y, along.x}, from = a + distance * inwards;
    rest = clip_convex({from - 100 * along, from + 100 * along, from + 100 * along + 100 * inwards,
                        from - 100 * along + 100 * inwards},
                       rest);
  }
  return rest;
}

TEST(ShrinkTest, OfAConvexRingIsWhatIsFarFromItsSides) {
  int vanished = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    Rng rng(seed, RngPurpose::kShapes);
    const Ring ring = random_convex(rng);
    if (signed_area(ring) < 1) continue;
    const double distance = rng.uniform(0, 6);
    const Ring smaller = shrink(ring, distance);
    const double expected = signed_area(cut_by_sides(ring, distance));
    EXPECT_NEAR(smaller.empty() ? 0 : signed_area(smaller), expected, 1e-7) << seed;
    vanished += smaller.empty();
  }
  EXPECT_GT(vanished, 100);
}

TEST(ShrinkTest, OfAHollowRingKeepsItsDistance) {
  const Ring arrow = {{0, 0}, {10, 6}, {0, 12}, {3, 6}};
  const Ring smaller = shrink(arrow, 0.5);
  ASSERT_EQ(smaller.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k : {i, (i + 1) % 4}) {
      const Point way = arrow[(i + 1) % 4] - arrow[i];
      EXPECT_NEAR(cross(way, smaller[k] - arrow[i]) / length(way), 0.5, 1e-12);
    }
  EXPECT_TRUE(shrink(arrow, 4).empty());
}

// Of a cell's own area what is nearer to its sides than half a border is the border's.
TEST(ShrinkTest, BordersTakeTheirShareOfEveryModel) {
  for (const Model model : {Model::kOccupancy, Model::kPoissonLines, Model::kDelaunay, Model::kJohnsonMehl}) {
    Params params;
    params.model = model;
    params.seamless = true;
    params.size = 40;
    const auto bare = run({}, params, 1, {});
    params.border = 0.2;
    const auto bordered = run({}, params, 1, {});
    ASSERT_TRUE(bare && bordered);
    double sides = 0, lost = 0;
    for (const Piece& piece : bare->sheet.pieces) {
      sides += perimeter(piece.outline.outer);
      lost += area(piece.outline);
    }
    for (const Piece& piece : bordered->sheet.pieces) lost -= area(piece.outline);
    EXPECT_NEAR(lost / (0.1 * sides), 1, 0.02) << static_cast<int>(model);  // corners count twice, hence less
  }
}

bool holds(const Ring& convex, Point p) {
  for (std::size_t i = 0; i < convex.size(); ++i)
    if (cross(convex[(i + 1) % convex.size()] - convex[i], p - convex[i]) < 0) return false;
  return true;
}

TEST(ShrinkTest, AThickerBorderLeavesThePatternAsItIs) {
  Params params;
  params.size = 60;
  params.border = 1;
  const auto thin = run({}, params, 1, {});
  params.border = 9;
  const auto thick = run({}, params, 1, {});
  ASSERT_TRUE(thin && thick);
  EXPECT_GT(thick->sheet.pieces.size(), 50u);
  for (const Piece& piece : thick->sheet.pieces) {
    const Point middle = centroid(piece.outline.outer);
    const auto& pieces = thin->sheet.pieces;
    const auto around = std::find_if(pieces.begin(), pieces.end(),
                                     [&](const Piece& other) { return holds(other.outline.outer, middle); });
    ASSERT_NE(around, pieces.end());
    EXPECT_EQ(around->fill, piece.fill);
  }
}

}  // namespace
}  // namespace tessera::patterns
