// Outlines r(phi) of labels, their painting, and the sizes of grains.
#include "tessera/pebbles/outlines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "labels.h"
#include "tessera/base/portable_math.h"
#include "tessera/pebbles/grains.h"

namespace tessera::pebbles {
namespace {

// An ellipse with half axes a and b, turned by `turn` radians.
Pebble ellipse_at(Point centre, double a, double b, double turn, int directions = kDirections) {
  Pebble pebble{1, centre, {}, 0};
  for (int k = 0; k < directions; ++k) {
    const SinCos way = sin_cos(2 * kPi * k / directions - turn);
    pebble.radii.push_back(a * b / std::sqrt(b * b * way.cos * way.cos + a * a * way.sin * way.sin));
  }
  return pebble;
}

// Smooth, star-shaped, with three bumps at most.
Pebble star(Rng& rng, Point centre, double radius) {
  Pebble pebble{1, centre, {}, 0};
  const double depth = rng.uniform(0, 0.25), turn = rng.uniform(0, 2 * kPi), stretch = rng.uniform(0, 0.3);
  const int bumps = 1 + below(rng, 3);
  for (int k = 0; k < kDirections; ++k) {
    const double phi = 2 * kPi * k / kDirections;
    pebble.radii.push_back(radius * (1 + depth * sin_cos(bumps * phi + turn).sin + stretch * sin_cos(2 * phi).cos));
  }
  return pebble;
}

double overlap(const cv::Mat& a, const cv::Mat& b) {
  return static_cast<double>(cv::countNonZero(a & b)) / std::max(1, cv::countNonZero(a | b));
}

TEST(Outlines, ADiscsRadiiAreItsRadius) {
  for (const int radius : {6, 15, 40}) {
    std::vector<Pebble> drawn{ellipse_at({50.5, 49.5}, radius + 0.3, radius + 0.3, 0)};
    const cv::Mat1i labels = paint_labels(drawn, {100, 100});
    const std::vector<Pebble> found = fit_outlines(labels);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].id, 1);
    EXPECT_NEAR(found[0].centre.x, 50.5, 0.01);
    EXPECT_NEAR(found[0].centre.y, 49.5, 0.01);
    EXPECT_EQ(found[0].area_px, pixels_of(labels, 1));
    for (const double r : found[0].radii) EXPECT_NEAR(r, radius + 0.3, 0.8) << radius;
  }
}

TEST(Outlines, AnEllipsesAreItsOwn) {
  for (const double turn : {0.0, 0.4, 1.3, 2.6}) {
    std::vector<Pebble> drawn{ellipse_at({70, 65}, 50, 30, turn)};
    const std::vector<Pebble> found = fit_outlines(paint_labels(drawn, {140, 130}));
    ASSERT_EQ(found.size(), 1u);
    ASSERT_EQ(found[0].radii.size(), drawn[0].radii.size());
    for (std::size_t k = 0; k < drawn[0].radii.size(); ++k)
      EXPECT_NEAR(found[0].radii[k], drawn[0].radii[k], 1.5)  // evening takes 0.9 off the tips
          << turn << ' ' << k;
  }
}

TEST(Outlines, StarShapesComeBack) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Rng rng(seed, RngPurpose::kShapes);
    std::vector<Pebble> drawn{star(rng, {75, 80}, rng.uniform(12, 45))};
    const cv::Mat1i labels = paint_labels(drawn, {150, 160});
    std::vector<Pebble> found = fit_outlines(labels);
    ASSERT_EQ(found.size(), 1u);
    const cv::Mat1i again = paint_labels(found, labels.size());
    EXPECT_GT(overlap(labels == 1, again == 1), 0.92) << seed;
  }
}

TEST(Outlines, PaintedAreaIsTheOutlines) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Rng rng(seed, RngPurpose::kShapes);
    std::vector<Pebble> pebbles{star(rng, {75.3, 80.8}, rng.uniform(12, 45))};
    const cv::Mat1i labels = paint_labels(pebbles, {150, 160});
    EXPECT_EQ(pebbles[0].area_px, pixels_of(labels, 1));
    EXPECT_NEAR(pebbles[0].area_px / signed_area(outline(pebbles[0])), 1, 0.03) << seed;
  }
}

TEST(Outlines, PixelsOfTwoGoToTheNearer) {
  std::vector<Pebble> pebbles{ellipse_at({30, 30}, 20, 20, 0), ellipse_at({50, 30}, 20, 20, 0)};
  pebbles[1].id = 2;
  const cv::Mat1i labels = paint_labels(pebbles, {80, 60});
  EXPECT_EQ(pebbles[0].area_px, pebbles[1].area_px);
  EXPECT_EQ(pebbles[0].area_px + pebbles[1].area_px, cv::countNonZero(labels));
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x)
      if (labels(y, x) != 0) {
        EXPECT_EQ(labels(y, x), x < 40 ? 1 : 2) << x << ' ' << y;
      }
}

TEST(Outlines, WhatReachesBeyondThePictureIsCut) {
  std::vector<Pebble> pebbles{ellipse_at({2, 3}, 20, 20, 0)};
  const cv::Mat1i labels = paint_labels(pebbles, {40, 30});
  EXPECT_EQ(pebbles[0].area_px, cv::countNonZero(labels));
  EXPECT_LT(pebbles[0].area_px, kPi * 400 / 2);
}

TEST(Outlines, LabelsWithoutPixelsAreLeftOut) {
  const std::vector<Pebble> pebbles = fit_outlines(labels_of({"0000000", "0220550", "0220550", "0000000"}));
  ASSERT_EQ(pebbles.size(), 2u);
  EXPECT_EQ(pebbles[0].id, 2);
  EXPECT_EQ(pebbles[1].id, 5);
  EXPECT_EQ(pebbles[1].centre, (Point{5, 2}));
  for (const double r : pebbles[0].radii) EXPECT_GT(r, 0);
  EXPECT_TRUE(fit_outlines(cv::Mat1i(4, 4, 0)).empty());
}

TEST(Outlines, GrowWithThePicture) {
  std::vector<Pebble> pebbles{ellipse_at({10, 20}, 6, 4, 1)};
  pebbles[0].area_px = 75;
  const double before = signed_area(outline(pebbles[0]));
  enlarge(3, pebbles);
  EXPECT_EQ(pebbles[0].centre, (Point{30, 60}));
  EXPECT_DOUBLE_EQ(pebbles[0].area_px, 675);
  EXPECT_NEAR(signed_area(outline(pebbles[0])), 9 * before, 1e-9);
}

TEST(Grains, AnEllipsesAxesAreItsOwn) {
  for (const double turn : {0.0, 0.3, 1.2, 1.6, 2.9}) {
    const std::vector<Grain> grains = measure_grains({ellipse_at({300, -5}, 80, 35, turn, 720)});
    ASSERT_EQ(grains.size(), 1u);
    EXPECT_NEAR(grains[0].a, 160, 0.02) << turn;
    EXPECT_NEAR(grains[0].b, 70, 0.02) << turn;
    EXPECT_NEAR(grains[0].area, kPi * 80 * 35, 1) << turn;
    const double off = std::fabs(grains[0].orientation_deg - turn * 180 / kPi);
    EXPECT_LT(std::min(off, 180 - off), 0.01) << turn;
  }
}

TEST(Grains, AxesHaveTheOutlinesArea) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Rng rng(seed, RngPurpose::kShapes);
    const Pebble pebble = star(rng, {10, 10}, rng.uniform(2, 90));
    const Grain grain = measure_grains({pebble})[0];
    EXPECT_NEAR(grain.area, signed_area(outline(pebble)), 1e-9 * grain.area);
    EXPECT_NEAR(grain.a * grain.b * kPi / 4, grain.area, 1e-9 * grain.area);
    EXPECT_GE(grain.a, grain.b);
    EXPECT_TRUE(grain.orientation_deg >= 0 && grain.orientation_deg < 180) << grain.orientation_deg;
  }
}

TEST(Grains, PercentilesLieBetweenTheMiddlesOfTheSorted) {
  EXPECT_EQ(percentile({}, 0.5), 0);
  EXPECT_EQ(percentile({7}, 0), 7);
  EXPECT_EQ(percentile({7}, 1), 7);
  EXPECT_DOUBLE_EQ(percentile({3, 1, 2}, 0.5), 2);
  EXPECT_DOUBLE_EQ(percentile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(percentile({10, 20, 30, 40}, 0.25), 15);
  EXPECT_EQ(percentile({10, 20, 30, 40}, 0.05), 10);
  EXPECT_EQ(percentile({10, 20, 30, 40}, 0.95), 40);
}

}  // namespace
}  // namespace tessera::pebbles
