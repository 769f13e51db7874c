#include "tessera/image/distance_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tessera/base/portable_math.h"
#include "tessera/base/rng.h"

namespace tessera {
namespace {

constexpr double kSqrt2 = 1.4142135623730951;

cv::Mat1b random_zones(const cv::Size& size, double share, Rng& rng) {
  cv::Mat1b zones(size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      zones(y, x) = rng.uniform() < share ? static_cast<unsigned char>(1 + rng.bits() % 3) : 0;
  return zones;
}

std::vector<cv::Point> frontier_pixels(const cv::Mat1b& zones) {
  std::vector<cv::Point> pixels;
  for (int y = 0; y < zones.rows; ++y) {
    for (int x = 0; x < zones.cols; ++x) {
      bool differs = false;
      for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        const int i = x + dx, j = y + dy;
        if (i >= 0 && j >= 0 && i < zones.cols && j < zones.rows) differs |= zones(j, i) != zones(y, x);
      }
      if (differs) pixels.push_back({x, y});
    }
  }
  return pixels;
}

// Calls check(zones) for small maps with many, few and no frontiers.
template <class Check>
void for_random_maps(const Check& check) {
  Rng rng(1, RngPurpose::kNoise);
  const cv::Size sizes[] = {{1, 1}, {1, 9}, {12, 1}, {2, 2}, {7, 5}, {16, 16}, {31, 17}};
  for (const cv::Size& size : sizes)
    for (const double share : {0.0, 0.02, 0.1, 0.5}) check(random_zones(size, share, rng));
}

TEST(DistanceField, ExactDistanceAgreesWithSearchingAllPixels) {
  for_random_maps([](const cv::Mat1b& zones) {
    const DistanceField field = exact_distance(zones);
    const auto frontier = frontier_pixels(zones);
    ASSERT_EQ(field.size(), zones.size());
    for (int y = 0; y < zones.rows; ++y) {
      for (int x = 0; x < zones.cols; ++x) {
        double expected = kNoFrontier;
        for (const cv::Point p : frontier) expected = std::min(expected, std::hypot(p.x - x, p.y - y) + 0.5);
        ASSERT_NEAR(field(y, x), expected, 1e-4) << x << ", " << y << " of " << zones.size();
      }
    }
  });
}

TEST(DistanceField, ChamferDistanceByHand) {
  cv::Mat1b zones(5, 5, static_cast<unsigned char>(0));
  zones(2, 2) = 1;
  const DistanceField field = chamfer_distance(zones);
  const double near = 0.5, diagonal = kSqrt2 / 2;
  const double corner = diagonal + kSqrt2, side = diagonal + 1, middle = near + 1;
  const double expected[5][5] = {{corner, side, middle, side, corner},
                                 {side, diagonal, near, diagonal, side},
                                 {middle, near, near, near, middle},
                                 {side, diagonal, near, diagonal, side},
                                 {corner, side, middle, side, corner}};
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 5; ++x) EXPECT_NEAR(field(y, x), expected[y][x], 1e-6) << x << ", " << y;
}

// Steps of 1 and sqrt(2) are at most 8.24% longer than the straight way; beside a diagonal the paper starts at
// sqrt(2)/2 where the exact field has 1.5.
TEST(DistanceField, ChamferDistanceStaysNearTheExactOne) {
  for_random_maps([](const cv::Mat1b& zones) {
    const DistanceField exact = exact_distance(zones), chamfer = chamfer_distance(zones);
    ASSERT_EQ(chamfer.size(), zones.size());
    for (int y = 0; y < zones.rows; ++y) {
      for (int x = 0; x < zones.cols; ++x) {
        if (exact(y, x) == kNoFrontier) {
          ASSERT_EQ(chamfer(y, x), kNoFrontier);
          continue;
        }
        ASSERT_LE(chamfer(y, x), 1.0824 * (exact(y, x) - 0.5) + 0.5 + 1e-4);
        ASSERT_GE(chamfer(y, x), exact(y, x) - (1.5 - kSqrt2 / 2) - 1e-4);
      }
    }
  });
}

TEST(DistanceField, WithoutFrontiersThereIsNoDistance) {
  const cv::Mat1b zones(4, 6, static_cast<unsigned char>(3));
  for (const DistanceField& field : {exact_distance(zones), chamfer_distance(zones)})
    for (const float d : field) EXPECT_EQ(d, kNoFrontier);
}

TEST(DistanceField, UphillPointsAwayFromAStraightEdge) {
  constexpr int kSide = 96, kStep = 4;
  for (int degrees = 0; degrees < 360; degrees += 5) {
    const SinCos turn = sin_cos(degrees * kPi / 180);
    const cv::Vec2d normal(turn.cos, turn.sin);
    const auto height = [&](double x, double y) {
      return normal[0] * (x - kSide / 2.0) + normal[1] * (y - kSide / 2.0) - 0.2;
    };
    cv::Mat1b zones(kSide, kSide);
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) zones(y, x) = height(x + 0.5, y + 0.5) > 0;
    const DistanceField field = exact_distance(zones);
    for (int y = kSide / 4; y < kSide * 3 / 4; y += 3) {
      for (int x = kSide / 4; x < kSide * 3 / 4; x += 3) {
        const double h = height(x + 0.5, y + 0.5);
        if (std::fabs(h) < 7) continue;  // the operator would reach over the edge
        const cv::Vec2d up = uphill(field, x + 0.5, y + 0.5, kStep);
        ASSERT_NEAR(cv::norm(up), 1, 1e-9);
        const double cosine = up.dot(normal) * (h > 0 ? 1 : -1);
        ASSERT_GT(cosine, std::cos(10 * kPi / 180)) << degrees << " degrees, at " << x << ", " << y;
      }
    }
  }
}

TEST(DistanceField, UphillOfAPlaneIsItsSlopeAndOfAFlatFieldNothing) {
  DistanceField plane(40, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) plane(y, x) = 100 + 3.0f * x - 4.0f * y;
  for (const int step : {1, 2, 5}) {
    const cv::Vec2d up = uphill(plane, 20.3, 19.8, step);
    EXPECT_NEAR(up[0], 0.6, 1e-6);
    EXPECT_NEAR(up[1], -0.8, 1e-6);
  }
  const DistanceField flat(9, 9, 7.0f);
  for (double x = -3; x < 12; x += 1.5) EXPECT_EQ(uphill(flat, x, x, 2), cv::Vec2d(0, 0));
}

TEST(DistanceField, AtIsBilinearBetweenPixelCentres) {
  Rng rng(3, RngPurpose::kNoise);
  DistanceField field(6, 8);
  for (float& v : field) v = static_cast<float>(rng.uniform(0, 50));
  for (int i = 0; i < 500; ++i) {
    const double x = rng.uniform(0.5, 7.5), y = rng.uniform(0.5, 5.5);
    const int x0 = std::min(6, static_cast<int>(x - 0.5)), y0 = std::min(4, static_cast<int>(y - 0.5));
    const double s = x - 0.5 - x0, t = y - 0.5 - y0;
    const double expected = (1 - t) * ((1 - s) * field(y0, x0) + s * field(y0, x0 + 1)) +
                            t * ((1 - s) * field(y0 + 1, x0) + s * field(y0 + 1, x0 + 1));
    ASSERT_NEAR(at(field, x, y), expected, 1e-4);
  }
  for (int y = 0; y < field.rows; ++y)
    for (int x = 0; x < field.cols; ++x) EXPECT_EQ(at(field, x + 0.5, y + 0.5), field(y, x));
}

TEST(DistanceField, AtContinuesTheRimOutside) {
  DistanceField field(3, 4);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x) field(y, x) = static_cast<float>(10 * y + x);
  EXPECT_EQ(at(field, -5, -5), 0);
  EXPECT_EQ(at(field, 100, 100), 23);
  EXPECT_EQ(at(field, 0, 1.5), 10);
  EXPECT_EQ(at(field, 4, 1.5), 13);
  const DistanceField pixel(1, 1, 5.0f);
  EXPECT_EQ(at(pixel, 0.1, 0.9), 5);
}

}  // namespace
}  // namespace tessera
