// From a strength map to regions: basins, their tree, and the rims that are taken off.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>
#include <vector>

#include "labels.h"
#include "tessera/base/portable_math.h"
#include "tessera/pebbles/distinct.h"
#include "tessera/pebbles/neighbours.h"
#include "tessera/pebbles/region_tree.h"
#include "tessera/pebbles/rims.h"
#include "tessera/pebbles/watershed.h"

namespace tessera::pebbles {
namespace {

cv::Mat1w random_heights(int width, int height, int levels, std::uint64_t seed) {
  Rng rng(seed, RngPurpose::kNoise);
  cv::Mat1w heights(height, width);
  for (std::uint16_t& h : heights) h = static_cast<std::uint16_t>(below(rng, levels));
  return heights;
}

int parts_of(const cv::Mat1i& labels, int label) {
  cv::Mat1i parts;
  return cv::connectedComponents(labels == label, parts, 4) - 1;
}

TEST(Watershed, ValleysBetweenRidgesAreBasins) {
  // 3 x 2 valleys of different depths, ridges of 100 between them.
  cv::Mat1w heights(20, 30);
  for (int y = 0; y < heights.rows; ++y)
    for (int x = 0; x < heights.cols; ++x) {
      const int from_middle = std::max(std::abs(x % 10 - 5), std::abs(y % 10 - 5));
      heights(y, x) = static_cast<std::uint16_t>(from_middle == 5 ? 100 : 10 * from_middle + x / 10);
    }
  const Basins basins = watershed(heights, 1);
  EXPECT_EQ(basins.count, 6);
  std::set<int> middles;
  for (int y = 5; y < 20; y += 10)
    for (int x = 5; x < 30; x += 10) {
      middles.insert(basins.labels(y, x));
      for (int d = -4; d <= 4; ++d) EXPECT_EQ(basins.labels(y + d, x - d), basins.labels(y, x));
    }
  EXPECT_EQ(middles.size(), 6u);
}

TEST(Watershed, ShallowBasinsFlowOverTheirLowestBorder) {
  // Valleys at 0, 40 and 10; the second is 20 deep and spills to its right, at 60, before it would to its left,
  // at 70.
  const cv::Mat1w heights = (cv::Mat1w(1, 9) << 0, 30, 70, 50, 40, 60, 20, 10, 30);
  EXPECT_EQ(watershed(heights, 20).count, 3);
  const Basins basins = watershed(heights, 21);
  EXPECT_EQ(basins.count, 2);
  EXPECT_EQ(basins.labels(0, 4), basins.labels(0, 7));
  EXPECT_NE(basins.labels(0, 0), basins.labels(0, 4));
  EXPECT_EQ(watershed(heights, 1000).count, 1);
}

TEST(Watershed, APlainIsOneBasin) {
  const Basins basins = watershed(cv::Mat1w(5, 7, std::uint16_t{65535}), 1);
  EXPECT_EQ(basins.count, 1);
  EXPECT_EQ(cv::countNonZero(basins.labels), 0);
}

TEST(Watershed, BasinsArePartsThatHangTogetherAroundAValley) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const cv::Mat1w heights = random_heights(25, 18, 4 + 30 * static_cast<int>(seed % 3), seed);
    const Basins basins = watershed(heights, 1);
    std::vector<char> has_valley(basins.count, 0);
    for (const int label : basins.labels) {
      ASSERT_GE(label, 0);
      ASSERT_LT(label, basins.count);
    }
    // From every pixel water finds its way down within the basin: a plateau without a lower neighbour is its valley.
    for (int label = 0; label < basins.count; ++label) EXPECT_EQ(parts_of(basins.labels, label), 1) << seed;
    for (int y = 0; y < heights.rows; ++y)
      for (int x = 0; x < heights.cols; ++x) {
        bool lowest = true;
        each_neighbour(heights, y, x, [&](int v, int u) { lowest &= heights(v, u) >= heights(y, x); });
        if (lowest) has_valley[basins.labels(y, x)] = 1;
      }
    EXPECT_EQ(std::count(has_valley.begin(), has_valley.end(), 1), basins.count) << seed;
  }
}

TEST(Watershed, DeeperMeansFewerBasins) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const cv::Mat1w heights = random_heights(40, 30, 500, seed);
    int last = 40 * 30;
    for (const int depth : {1, 50, 100, 200, 400, 500}) {
      const int count = watershed(heights, depth).count;
      EXPECT_LE(count, last) << seed << ' ' << depth;
      last = count;
    }
    EXPECT_EQ(last, 1);
  }
}

Moments moments_of(const cv::Mat1b& inside) {
  Moments m;
  for (std::int64_t y = 0; y < inside.rows; ++y)
    for (std::int64_t x = 0; x < inside.cols; ++x)
      if (inside(static_cast<int>(y), static_cast<int>(x)) != 0) m += {1, x, y, x * x, x * y, y * y};
  return m;
}

TEST(RegionTree, AnEllipsesMomentsSayItsArea) {
  for (const int turn : {0, 30, 77}) {
    cv::Mat1b inside(200, 200, std::uint8_t{0});
    cv::ellipse(inside, {100, 100}, {80, 45}, turn, 0, 360, 255, -1);
    const Moments m = moments_of(inside);
    EXPECT_NEAR(m.ellipse_area() / static_cast<double>(m.count), 1, 0.01) << turn;
  }
  // A square of side s: s^2 pi / 3.
  EXPECT_NEAR(moments_of(cv::Mat1b(1, 1, std::uint8_t{1})).ellipse_area(), kPi / 3, 1e-12);
  EXPECT_NEAR(moments_of(cv::Mat1b(7, 7, std::uint8_t{1})).ellipse_area(), 49 * kPi / 3, 1e-9);
}

// Area of the hull of the corners of a set of pixels, from all corners.
double hull_area_of(const std::vector<char>& inside, const cv::Mat1i& labels) {
  std::vector<cv::Point> corners;
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x)
      if (inside[labels(y, x)])
        for (const cv::Point d : {cv::Point(0, 0), cv::Point(1, 0), cv::Point(0, 1), cv::Point(1, 1)})
          corners.push_back(cv::Point(x, y) + d);
  std::vector<cv::Point> hull;
  cv::convexHull(corners, hull);
  return cv::contourArea(hull);
}

// Mean over pairs of neighbours, one in each set, of the larger strength; less than 0: there are none.
double border_between(const std::vector<char>& a, const std::vector<char>& b, const cv::Mat1i& labels,
                      const cv::Mat1w& strength) {
  double sum = 0, count = 0;
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x)
      if (a[labels(y, x)])
        each_neighbour(labels, y, x, [&](int v, int u) {
          if (!b[labels(v, u)]) return;
          sum += std::max(strength(y, x), strength(v, u));
          ++count;
        });
  return count > 0 ? sum / count : -1;
}

class RandomTrees : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    strength = random_heights(16, 12, 300, static_cast<std::uint64_t>(GetParam()));
    basins = watershed(strength, 60);
    regions = region_tree(basins, strength);
    for (int r = 0; r < static_cast<int>(regions.size()); ++r) {
      std::vector<char> own(basins.count, 0);
      if (r < basins.count) own[r] = 1;
      for (const int part : {regions[r].left, regions[r].right})
        for (int b = 0; part >= 0 && b < basins.count; ++b) own[b] |= basins_of[part][b];
      basins_of.push_back(own);
    }
  }
  cv::Mat1w strength;
  Basins basins;
  std::vector<Region> regions;
  std::vector<std::vector<char>> basins_of;  // of each region
};

TEST_P(RandomTrees, JoinsAllIntoOne) {
  ASSERT_EQ(static_cast<int>(regions.size()), 2 * basins.count - 1);
  EXPECT_EQ(regions.back().parent, -1);
  EXPECT_EQ(regions.back().moments.count, static_cast<std::int64_t>(strength.total()));
  EXPECT_EQ(regions.back().border, 2 * (16 + 12));
  for (int r = basins.count; r < static_cast<int>(regions.size()); ++r) {
    EXPECT_EQ(regions[regions[r].left].parent, r);
    EXPECT_EQ(regions[regions[r].right].parent, r);
  }
}

TEST_P(RandomTrees, MeasuresWhatItsPixelsSay) {
  for (std::size_t r = 0; r < regions.size(); ++r) {
    cv::Mat1b inside(strength.size());
    for (int y = 0; y < strength.rows; ++y)
      for (int x = 0; x < strength.cols; ++x)
        inside(y, x) = static_cast<std::uint8_t>(basins_of[r][basins.labels(y, x)]);
    const Moments truth = moments_of(inside), &own = regions[r].moments;
    EXPECT_EQ(own.count, truth.count);
    EXPECT_TRUE(own.x == truth.x && own.y == truth.y && own.xx == truth.xx && own.xy == truth.xy &&
                own.yy == truth.yy);
    EXPECT_DOUBLE_EQ(regions[r].hull_area, hull_area_of(basins_of[r], basins.labels)) << r;
  }
}

TEST_P(RandomTrees, JoinsTheTwoWithTheWeakestBorder) {
  std::set<int> left;
  for (int b = 0; b < basins.count; ++b) left.insert(b);
  for (int r = basins.count; r < static_cast<int>(regions.size()); ++r) {
    double weakest = 1e9;
    for (const int a : left)
      for (const int b : left) {
        const double border = a < b ? border_between(basins_of[a], basins_of[b], basins.labels, strength) : -1;
        if (border >= 0) weakest = std::min(weakest, border);
      }
    ASSERT_DOUBLE_EQ(regions[r].joined_at, weakest) << r;
    ASSERT_DOUBLE_EQ(border_between(basins_of[regions[r].left], basins_of[regions[r].right], basins.labels, strength),
                     weakest);
    left.erase(regions[r].left);
    left.erase(regions[r].right);
    left.insert(r);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomTrees, testing::Range(0, 8));

TEST(Neighbours, TheLargestPartStays) {
  cv::Mat1i labels = labels_of({"1100222", "1001022", "0011000", "3011303"});
  keep_largest_parts(labels, 3);
  EXPECT_EQ(cv::countNonZero(labels != labels_of({"0000222", "0001022", "0011000", "3011000"})), 0);
}

// A disc of lightness `body` in a gap of `gap`, on a region that reaches `rim` px beyond the disc.
struct Rimmed {
  cv::Mat3b photo;
  cv::Mat1i labels;
  cv::Mat1b disc;
};

Rimmed rimmed(int radius, int rim, int body, int gap) {
  const int side = 2 * (radius + rim) + 11;
  const cv::Point middle{side / 2, side / 2};
  Rimmed r{cv::Mat3b(side, side, cv::Vec3b::all(static_cast<std::uint8_t>(gap))), cv::Mat1i(side, side, 0),
           cv::Mat1b(side, side, std::uint8_t{0})};
  cv::circle(r.photo, middle, radius, cv::Scalar::all(body), -1);
  cv::circle(r.labels, middle, radius + rim, 1, -1);
  cv::circle(r.disc, middle, radius, 255, -1);
  return r;
}

TEST(Rims, DarkOnesAreTakenOff) {
  for (const int radius : {16, 24, 40}) {
    Rimmed r = rimmed(radius, radius / 8, 180, 30);  // less than the share that is not the body's
    trim_rims(r.photo, r.labels);
    const int differing = cv::countNonZero((r.labels > 0) != (r.disc > 0));
    EXPECT_LT(differing, 0.05 * cv::countNonZero(r.disc)) << radius;
  }
}

TEST(Rims, LightOnesStay) {
  Rimmed r = rimmed(20, 3, 120, 200);
  const cv::Mat1i before = r.labels.clone();
  trim_rims(r.photo, r.labels);
  EXPECT_EQ(cv::countNonZero(r.labels != before), 0);
}

// A light disc on dark ground, faintly grained: whether it counts as a pebble. A disc of the smallest size has
// radius 4.
bool is_distinct(double radius, cv::Point2d middle, int lightness = 200, double hollow = 0) {
  Rng rng(1, RngPurpose::kNoise);
  cv::Mat3b photo(60, 80);
  cv::Mat1i labels(photo.size(), 0);
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) {
      const double apart = std::hypot(x - middle.x, y - middle.y);
      labels(y, x) = apart <= radius && apart >= hollow ? 1 : 0;
      photo(y, x) = cv::Vec3b::all(static_cast<std::uint8_t>((labels(y, x) != 0 ? lightness : 60) + below(rng, 4)));
    }
  Params params;
  params.smallest = 8;
  drop_indistinct(photo, params, labels);
  return pixels_of(labels, 1) > 0;
}

TEST(Distinct, ALightDiscIsAPebble) { EXPECT_TRUE(is_distinct(6, {40, 30})); }

TEST(Distinct, SmallOnesAreNone) {
  EXPECT_TRUE(is_distinct(4.5, {40, 30}));
  EXPECT_FALSE(is_distinct(3.2, {40, 30}));
}

TEST(Distinct, OfPebblesThatThePictureCutsMoreHasToShow) {
  for (const cv::Point2d middle : {cv::Point2d{0, 30}, {79, 30}, {40, 0}, {40, 59}}) {
    EXPECT_FALSE(is_distinct(9, middle)) << middle;  // half of it: 127 px^2, less than a disc of 16 px across
    EXPECT_TRUE(is_distinct(13, middle)) << middle;  // 265 px^2
  }
}

TEST(Distinct, HollowOnesAreNone) { EXPECT_FALSE(is_distinct(14, {40, 30}, 200, 10)); }

TEST(Distinct, WhatDoesNotStandOutIsNone) { EXPECT_FALSE(is_distinct(10, {40, 30}, 61)); }

TEST(Rims, NothingIsAdded) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Rng rng(seed, RngPurpose::kNoise);
    cv::Mat3b photo(40, 50);
    for (cv::Vec3b& p : photo) p = cv::Vec3b::all(static_cast<std::uint8_t>(below(rng, 256)));
    cv::GaussianBlur(photo, photo, {7, 7}, 2);
    cv::Mat1i labels(photo.size());
    for (int y = 0; y < labels.rows; ++y)
      for (int x = 0; x < labels.cols; ++x) labels(y, x) = 1 + x / 17 + 3 * (y / 14);
    const cv::Mat1i before = labels.clone();
    trim_rims(photo, labels);
    EXPECT_EQ(cv::countNonZero((labels != before) & (labels != 0)), 0) << seed;
    for (int label = 1; label <= 9; ++label) EXPECT_LE(parts_of(labels, label), 1) << seed << ' ' << label;
  }
}

}  // namespace
}  // namespace tessera::pebbles
