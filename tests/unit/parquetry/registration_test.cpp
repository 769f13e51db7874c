#include "tessera/parquetry/registration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tessera/base/portable_math.h"
#include "tessera/base/rng.h"

namespace tessera::parquetry {
namespace {

using ::testing::HasSubstr;

Affine turned_by(double degrees, double scale, Point at) {
  const SinCos turn = sin_cos(degrees * kPi / 180);
  return {scale * turn.cos, -scale * turn.sin, scale * turn.sin, scale * turn.cos, at};
}

std::vector<Point> mapped(const Affine& map, const std::vector<Point>& points) {
  std::vector<Point> result;
  for (const Point p : points) result.push_back(map(p));
  return result;
}

const std::vector<Point> kCorners = {{5, 5}, {205, 6}, {204, 140}, {4, 141}};

TEST(Registration, FindsTheMapBehindExactPairs) {
  for (const double degrees : {0.0, 3.0, 90.0, 181.0, -40.0}) {
    const Affine map = turned_by(degrees, 1.003, {12, -7});
    for (const Registration kind : {Registration::kSimilarity, Registration::kAffine}) {
      const Fitted fitted = fit(kCorners, mapped(map, kCorners), kind);
      EXPECT_LT(fitted.rms, 1e-10);
      const Point p = fitted.map({100, 50}), expected = map({100, 50});
      EXPECT_NEAR(p.x, expected.x, 1e-9);
      EXPECT_NEAR(p.y, expected.y, 1e-9);
    }
  }
}

TEST(Registration, AffineTakesShearSimilarityDoesNot) {
  const Affine shear{1.01, 0.02, 0, 0.99, {3, 4}};
  const std::vector<Point> to = mapped(shear, kCorners);
  EXPECT_LT(fit(kCorners, to, Registration::kAffine).rms, 1e-10);
  EXPECT_GT(fit(kCorners, to, Registration::kSimilarity).rms, 0.3);
}

// One of four corners of a square off by d along a diagonal: least squares leave residuals whose squares sum to
// d^2 (1 - 1/4 - 1/4), as the shift takes a quarter and turn with size another.
TEST(Registration, LeastSquaresClosedForm) {
  const std::vector<Point> square = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  std::vector<Point> off = square;
  off[2] += Point{0.6, 0.8};
  const Fitted fitted = fit(square, off, Registration::kSimilarity);
  EXPECT_NEAR(4 * fitted.rms * fitted.rms, 0.5, 1e-9);
}

TEST(Registration, NoMapNearbyIsBetter) {
  Rng rng(5, RngPurpose::kShapes);
  for (int round = 0; round < 50; ++round) {
    std::vector<Point> to;
    for (const Point p : kCorners) to.push_back(p + Point{rng.uniform(-1, 1), rng.uniform(-1, 1)});
    const Fitted fitted = fit(kCorners, to, Registration::kSimilarity);
    for (int k = 0; k < 20; ++k) {
      Affine other = fitted.map;
      const double turn = rng.uniform(-1e-3, 1e-3), scale = rng.uniform(-1e-3, 1e-3);
      other.xx += scale, other.yy += scale, other.xy -= turn, other.yx += turn;
      other.at += Point{rng.uniform(-0.1, 0.1), rng.uniform(-0.1, 0.1)};
      double squares = 0;
      for (std::size_t i = 0; i < to.size(); ++i)
        squares += dot(other(kCorners[i]) - to[i], other(kCorners[i]) - to[i]);
      EXPECT_GE(squares, 4 * fitted.rms * fitted.rms - 1e-12);
    }
  }
}

TEST(Registration, PairsMarksByItself) {
  const std::vector<Point> odd = {{5, 5}, {205, 6}, {190, 140}, {30, 141}};
  for (const double degrees : {0.0, 90.0, 178.0}) {
    const Affine map = turned_by(degrees, 1, {300, 20});
    std::vector<Point> to = mapped(map, odd);
    std::rotate(to.begin(), to.begin() + 1, to.end());
    std::swap(to[0], to[2]);
    std::vector<Point> seen = odd;
    seen.push_back({77, 66});  // a mark that the machine does not have
    const auto fitted = fit_unordered(seen, to, Registration::kSimilarity);
    ASSERT_TRUE(fitted.has_value());
    EXPECT_LT(fitted->rms, 1e-9);
    EXPECT_NEAR(fitted->map({100, 50}).x, map({100, 50}).x, 1e-6);
  }
}

TEST(Registration, ARectangleIsNotTurnedOver) {
  const std::vector<Point> rectangle = {{0, 0}, {100, 0}, {100, 60}, {0, 60}};
  const auto fitted = fit_unordered(rectangle, rectangle, Registration::kSimilarity);
  ASSERT_TRUE(fitted.has_value());
  EXPECT_NEAR(fitted->map.xx, 1, 1e-9);
}

TEST(Registration, MarksOfAnotherScaleAreNotThose) {
  std::vector<Point> half;
  for (const Point p : kCorners) half.push_back(0.5 * p);
  EXPECT_FALSE(fit_unordered(kCorners, half, Registration::kSimilarity).has_value());
}

TEST(Registration, ABadFitIsRefusedWithFigures) {
  std::vector<Point> to = kCorners;
  to[1] += Point{2, 0};
  const auto bad = check_fit(fit(kCorners, to, Registration::kSimilarity), "oak");
  ASSERT_FALSE(bad.has_value());
  EXPECT_EQ(bad.error().field, "oak");
  EXPECT_THAT(bad.error().message, HasSubstr("mm rms"));
  EXPECT_THAT(bad.error().message, HasSubstr("at most 0.3 mm"));
  to[1] = kCorners[1] + Point{0.2, 0};
  EXPECT_TRUE(check_fit(fit(kCorners, to, Registration::kSimilarity), "oak").has_value());
}

}  // namespace
}  // namespace tessera::parquetry
