#include "tessera/geometry/bezier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../distances.h"
#include "tessera/base/rng.h"

namespace tessera {
namespace {

// Both ways, a hundred points a curve.
double distance_between(const Ring& line, const std::vector<Bezier>& curves) {
  Ring dense{curves.front()[0]};
  for (const Bezier& curve : curves)
    for (int k = 1; k <= 100; ++k) dense.push_back(point_at(curve, k / 100.0));
  double worst = 0;
  for (const Point p : line) worst = std::max(worst, distance_to(p, dense));
  for (const Point p : dense) worst = std::max(worst, distance_to(p, line));
  return worst;
}

// A walk that wanders, or one of waves, in steps of about a pixel.
Ring wandering(Rng& rng, int points) {
  Ring line{{0, 0}};
  const bool waves = rng.uniform() < 0.5;
  double way = rng.uniform(0, 6);
  for (int i = 1; i < points; ++i) {
    way += waves ? 0.1 * std::sin(0.2 * i) : rng.uniform(-0.6, 0.6);
    const double step = rng.uniform(0.7, 1.4);
    line.push_back(line.back() + Point{step * std::cos(way), step * std::sin(way)});
  }
  return line;
}

double turn_between(Point a, Point b) { return std::abs(std::atan2(cross(a, b), dot(a, b))); }

TEST(Bezier, StaysWithinTheErrorAndJoins) {
  Rng rng(1, RngPurpose::kShapes);
  for (int seed = 0; seed < 300; ++seed) {
    const Ring line = wandering(rng, 2 + seed % 60);
    for (const double error : {0.05, 0.3, 1.0})
      for (const Joints joints : {Joints::kG0, Joints::kG1}) {
        SCOPED_TRACE(testing::Message() << seed << ' ' << error << ' ' << static_cast<int>(joints));
        const auto curves = fit_beziers(line, error, joints);
        EXPECT_EQ(curves.front()[0], line.front());
        EXPECT_EQ(curves.back()[3], line.back());
        EXPECT_LT(curves.size(), line.size());
        EXPECT_LE(distance_between(line, curves), 1.05 * error);
        for (std::size_t i = 0; i + 1 < curves.size(); ++i) {
          EXPECT_EQ(curves[i][3], curves[i + 1][0]);
          if (joints == Joints::kG1) {
            EXPECT_LT(turn_between(curves[i][3] - curves[i][2], curves[i + 1][1] - curves[i + 1][0]), 1e-6);
          }
        }
      }
  }
}

TEST(Bezier, KeepsTheDirectionsAtItsEnds) {
  Rng rng(2, RngPurpose::kShapes);
  for (int seed = 0; seed < 100; ++seed) {
    const Ring line = wandering(rng, 2 + seed % 40);
    const auto near = [&](Point along) {
      const double way = std::atan2(along.y, along.x) + rng.uniform(-0.5, 0.5);
      return Point{std::cos(way), std::sin(way)};
    };
    const Point start = near(line[1] - line[0]), end = near(line.back() - line[line.size() - 2]);
    const auto curves = fit_beziers(line, 0.4, Joints::kG1, start, end);
    EXPECT_LT(turn_between(curves.front()[1] - curves.front()[0], start), 1e-6);
    EXPECT_LT(turn_between(curves.back()[3] - curves.back()[2], end), 1e-6);
    EXPECT_LE(distance_between(line, curves), 1.05 * 0.4);
  }
}

TEST(Bezier, FindsTheCurveThatItsPointsAreOf) {
  const Bezier curve = {Point{0, 0}, Point{10, 12}, Point{25, 14}, Point{40, 0}};
  Ring line;
  for (int k = 0; k <= 200; ++k) line.push_back(point_at(curve, k / 200.0));
  for (const Joints joints : {Joints::kG0, Joints::kG1}) EXPECT_EQ(fit_beziers(line, 0.2, joints).size(), 1u);
}

TEST(Bezier, IsFlatWithinTheTolerance) {
  Rng rng(3, RngPurpose::kShapes);
  for (int seed = 0; seed < 200; ++seed) {
    Bezier curve;
    for (Point& p : curve) p = {rng.uniform(-50, 50), rng.uniform(-50, 50)};
    for (const double tolerance : {0.01, 0.5}) {
      Ring line{curve[0]};
      flatten(curve, tolerance, line);
      EXPECT_EQ(line.back(), curve[3]);
      for (int k = 0; k <= 300; ++k) EXPECT_LE(distance_to(point_at(curve, k / 300.0), line), tolerance * (1 + 1e-9));
    }
  }
  Ring line{{0, 0}};
  flatten(straight({0, 0}, {9, 3}), 0.01, line);
  EXPECT_EQ(line.size(), 2u);
}

// Signed, at the end of one curve and the beginning of another.
double curvature_after(const Bezier& c) {
  return 2.0 / 3 * cross(c[1] - c[0], c[2] - c[1]) / std::pow(length(c[1] - c[0]), 3);
}
double curvature_before(const Bezier& c) { return curvature_after({c[3], c[2], c[1], c[0]}) * -1; }

TEST(Spline, IsSmoothToTheSecondOrder) {
  Rng rng(3, RngPurpose::kShapes);
  for (int seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Ring points;
    for (int k = 0; k < 2 + seed % 9; ++k) points.push_back({10 * k + rng.uniform(-4, 4), rng.uniform(-4, 4)});
    const double way = rng.uniform(-1, 1);
    const Point start = seed % 3 == 0 ? Point{} : Point{std::cos(way), std::sin(way)};
    const Point end = seed % 2 == 0 ? Point{} : Point{std::cos(way), -std::sin(way)};
    const auto curves = spline_through(points, start, end);
    ASSERT_EQ(curves.size() + 1, points.size());
    for (std::size_t k = 0; k < curves.size(); ++k) {
      EXPECT_EQ(curves[k][0], points[k]);
      EXPECT_EQ(curves[k][3], points[k + 1]);
      if (k == 0) continue;
      EXPECT_LT(turn_between(curves[k - 1][3] - curves[k - 1][2], curves[k][1] - curves[k][0]), 1e-9);
      EXPECT_NEAR(curvature_before(curves[k - 1]), curvature_after(curves[k]), 1e-9);
    }
    if (start == Point{})
      EXPECT_NEAR(curvature_after(curves.front()), 0, 1e-9);
    else
      EXPECT_LT(turn_between(start, curves.front()[1] - curves.front()[0]), 1e-9);
    if (end == Point{})
      EXPECT_NEAR(curvature_before(curves.back()), 0, 1e-9);
    else
      EXPECT_LT(turn_between(end, curves.back()[3] - curves.back()[2]), 1e-9);
  }
}

TEST(Spline, OfPointsOnALineIsTheLine) {
  for (const Bezier& curve : spline_through({{0, 0}, {1, 2}, {4, 8}, {5, 10}}))
    for (const Point p : curve) EXPECT_NEAR(2 * p.x, p.y, 1e-12);
}

}  // namespace
}  // namespace tessera
