// Mountains over edges.
#include "tessera/voronoi/ridges.h"

#include <gtest/gtest.h>

#include "tessera/base/rng.h"
#include "tessera/voronoi/cpu_rasterizer.h"

namespace tessera {
namespace {

DistanceField ridges_of(const cv::Mat1b& edges) {
  const auto heights = ridge_distance(edges, *make_cpu_rasterizer());
  EXPECT_TRUE(heights);
  return heights ? *heights : DistanceField();
}

TEST(RidgeDistance, WithoutEdgesThereIsNoMountain) {
  const DistanceField heights = ridges_of(cv::Mat1b::zeros(7, 9));
  EXPECT_EQ(cv::countNonZero(heights != kNoFrontier), 0);
}

TEST(RidgeDistance, APointIsACone) {
  cv::Mat1b edges = cv::Mat1b::zeros(40, 300);
  edges(11, 17) = 1;
  const DistanceField heights = ridges_of(edges);
  EXPECT_EQ(heights(11, 17), 0);
  EXPECT_EQ(heights(11, 299), 282);
  EXPECT_EQ(heights(14, 21), 5);
}

TEST(RidgeDistance, IsTheDistanceTransformOfManyPoints) {
  for (int seed = 0; seed < 20; ++seed) {
    Rng rng(seed, RngPurpose::kSites);
    cv::Mat1b edges = cv::Mat1b::zeros(90 + seed, 130 - seed);
    for (int i = 0; i < 1 + seed * seed; ++i)
      edges(static_cast<int>(rng.uniform(0, edges.rows)), static_cast<int>(rng.uniform(0, edges.cols))) = 255;
    const DistanceField heights = ridges_of(edges), expected = edge_distance(edges);
    EXPECT_LE(cv::norm(heights, expected, cv::NORM_INF), 0.1) << seed;
    EXPECT_LE(cv::countNonZero(cv::abs(heights - expected) > 0.01), static_cast<int>(edges.total()) / 1000) << seed;
  }
}

}  // namespace
}  // namespace tessera
