// Statistics against patterns whose answers are known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tessera/base/portable_math.h"
#include "tessera/points/processes.h"
#include "tessera/statistics/cells.h"
#include "tessera/statistics/classes.h"
#include "tessera/statistics/needles.h"
#include "tessera/statistics/points.h"

namespace tessera::statistics {
namespace {

struct Pixels {
  cv::Mat3b mat;
  ImageView view() const { return {mat.data, mat.cols, mat.rows, static_cast<std::ptrdiff_t>(mat.step)}; }
};

// Stripes of 8 px, of three colours in turn.
Pixels stripes() {
  Pixels p{cv::Mat3b(96, 192)};
  const cv::Vec3b colours[] = {{250, 10, 10}, {10, 250, 10}, {10, 10, 250}};
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 192; ++x) p.mat(y, x) = colours[x / 8 % 3];
  return p;
}

TEST(ClassesTest, FindTheColoursThatAreThere) {
  const Classes classes = find_classes(stripes().view(), 0);
  EXPECT_TRUE(classes.discrete);
  ASSERT_EQ(classes.colours.size(), 3u);
  for (const double share : shares_of(classes)) EXPECT_NEAR(share, 1.0 / 3, 1e-9);
  for (int x = 0; x < 192; ++x) EXPECT_EQ(classes.labels(5, x), classes.labels(90, x / 8 % 3 * 8));
}

TEST(ClassesTest, WhatIsBetweenTwoColoursIsOneOfThem) {
  Pixels p = stripes();
  // A border as smooth drawing leaves it, whose colour is the third one's, nearly.
  p.mat(cv::Rect(0, 0, 24, 96)).setTo(cv::Scalar(250, 10, 10));
  p.mat(cv::Rect(24, 0, 24, 96)).setTo(cv::Scalar(10, 10, 250));
  p.mat.col(24).setTo(cv::Scalar(110, 60, 120));
  const Classes classes = find_classes(p.view(), 0);
  ASSERT_EQ(classes.colours.size(), 3u);
  const int label = classes.labels(50, 24);
  EXPECT_TRUE(label == classes.labels(50, 20) || label == classes.labels(50, 30));
}

TEST(ClassesTest, OfAPhotoThereAreAsManyAsWanted) {
  Pixels p{cv::Mat3b(64, 64)};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) p.mat(y, x) = {static_cast<uchar>(4 * x), static_cast<uchar>(4 * y), 128};
  EXPECT_EQ(find_classes(p.view(), 5).colours.size(), 5u);
  EXPECT_FALSE(find_classes(p.view(), 0).discrete);
  Pixels flat{cv::Mat3b(8, 8, cv::Vec3b(9, 9, 9))};
  EXPECT_EQ(find_classes(flat.view(), 0).colours.size(), 1u);
}

TEST(NeedlesTest, TellOfStripesWhatGeometryDoes) {
  const Pixels p = stripes();
  const Classes classes = find_classes(p.view(), 0);
  EXPECT_NEAR(boundary_crossings(classes), 23.0 * 96 / (2 * 96 * 192), 1e-9);
  for (const double width : patch_widths(classes)) EXPECT_NEAR(width, 8, 1e-9);
  Rng rng(1, RngPurpose::kSites);
  const auto needles = throw_needles(p.view(), classes, {3, 12}, 40000, rng, {});
  ASSERT_EQ(needles.size(), 2u);
  // A needle of length d < 8 stays in its stripe with the chance 1 - 2 d / (8 pi).
  const double stays = 1 - 2 * 3 / (8 * kPi);
  const double agree = needles[0].same_cell * (2.0 / 3) + 1.0 / 3;
  EXPECT_NEAR(agree, stays, 0.01);
  EXPECT_NEAR(needles[0].transitions[0], stays, 0.015);
  // Two colours differ by 240 levels in two channels.
  EXPECT_NEAR(needles[0].variogram, 2 * 240.0 * 240 * (1 - stays), 2000);
  double all = 0;
  for (const double chance : needles[0].co_occurrence) all += chance;
  EXPECT_NEAR(all, 1, 1e-9);
  for (const NeedleStatistics& s : needles)
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(s.transitions[3 * i] + s.transitions[3 * i + 1] + s.transitions[3 * i + 2], 1, 1e-9);
}

TEST(CellStatisticsTest, OfAGridOfRectangles) {
  std::vector<Ring> cells;
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 5; ++j) {
      const double x = 3 * i, y = 4 * j;
      cells.push_back(
          {{x, y}, {x + 3, y}, {x + 3, y + 4}, {x + 1, y + 4}, {x, y + 4}});  // a vertex on a straight side
    }
  const Window window{{0, 0}, {30, 20}};
  const CellStatistics s = cell_statistics(cells, window);
  EXPECT_EQ(s.cells, 50);
  EXPECT_EQ(s.inner, 24);
  EXPECT_NEAR(s.area.mean, 12, 1e-12);
  EXPECT_NEAR(s.area.variance, 0, 1e-12);
  EXPECT_NEAR(s.perimeter.mean, 14, 1e-12);
  EXPECT_NEAR(s.sides.mean, 4, 1e-12);
  EXPECT_NEAR(s.side_shares.at(4), 1, 1e-12);
  const cv::Mat1i drawn = draw_cells(cells, window, 0.5);
  EXPECT_EQ(drawn.size(), cv::Size(60, 40));
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) ASSERT_EQ(drawn(y, x), x / 6 * 5 + y / 8);
}

// By hand, and against a count of all pairs.
TEST(PointStatisticsTest, EqualABruteForceCount) {
  const Window window{{1, 2}, {31, 22}};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed, RngPurpose::kSites);
    const auto points = poisson_points(window, 0.3, rng);
    const std::vector<double> radii = {0.5, 1, 2, 4};
    const PointStatistics s = point_statistics(points, window, radii);
    EXPECT_NEAR(s.intensity, static_cast<double>(points.size()) / 600, 1e-12);
    double before = 0;
    for (std::size_t b = 0; b < radii.size(); ++b) {
      double inner = 0, pairs = 0, ring = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Point low = points[i] - window.low, high = window.high - points[i];
        if (std::min({low.x, low.y, high.x, high.y}) < radii[b]) continue;
        ++inner;
        for (std::size_t k = 0; k < points.size(); ++k) {
          const double away = length(points[k] - points[i]);
          if (k != i && away <= radii[b]) ++pairs;
          if (k != i && away <= radii[b] && away > before) ++ring;
        }
      }
      EXPECT_NEAR(s.k[b], pairs / inner / s.intensity, 1e-9);
      EXPECT_NEAR(s.pair_correlation[b], ring / inner / s.intensity / kPi / (radii[b] * radii[b] - before * before),
                  1e-9);
      before = radii[b];
    }
  }
}

// p-values of a Poisson process's K over many seeds are spread evenly: a fifth in each fifth of a normal
// distribution.
TEST(PointStatisticsTest, KOfPoissonPointsIsNormalAboutItsClosedForm) {
  constexpr int kSeeds = 200;
  const Window window{{0, 0}, {40, 40}, true};
  std::vector<double> values;
  double mean = 0, square = 0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed), RngPurpose::kSites);
    values.push_back(point_statistics(poisson_points(window, 0.5, rng), window, {2}).k[0]);
    mean += values.back() / kSeeds;
  }
  for (const double v : values) square += (v - mean) * (v - mean) / (kSeeds - 1);
  EXPECT_NEAR(mean, 4 * kPi, 3.5 * std::sqrt(square / kSeeds));
  // With n points given, pairs within t are nearly Poisson of mean n^2 pi t^2 / (2 A): the variance of K is 2 A pi
  // t^2 / n^2.
  EXPECT_NEAR(square / (2 * 1600 * 4 * kPi / (800.0 * 800)), 1, 0.35);
  int fifths[5] = {};
  for (const double v : values) {
    const double p = 0.5 * std::erfc(-(v - mean) / std::sqrt(2 * square));
    ++fifths[std::min(4, static_cast<int>(5 * p))];
  }
  double chi_square = 0;
  for (const int count : fifths) chi_square += (count - 40.0) * (count - 40.0) / 40;
  EXPECT_LT(chi_square, 18.5);  // one in a thousand
}

TEST(PointStatisticsTest, FewPointsAndNone) {
  const Window window{{0, 0}, {10, 10}};
  EXPECT_EQ(point_statistics({}, window, {1}).k[0], 0);
  const PointStatistics one = point_statistics({{5, 5}}, window, {1, 2});
  EXPECT_EQ(one.nearest, 0);
  EXPECT_EQ(one.k[1], 0);
  EXPECT_NEAR(point_statistics({{5, 5}, {5, 7}}, window, {1}).nearest, 2, 1e-12);
}

}  // namespace
}  // namespace tessera::statistics
