// Mountains in the depth buffer against the distance transform, and what their gradients say.
#include "tessera/voronoi/ridges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "gl_context.h"
#include "tessera/base/portable_math.h"
#include "tessera/base/rng.h"
#include "tessera/gpu/gl_rasterizer.h"
#include "tessera/voronoi/cpu_rasterizer.h"

namespace tessera {
namespace {

// Curves, circles and single pixels, a pixel thin.
cv::Mat1b random_edges(cv::Size size, int seed) {
  Rng rng(seed, RngPurpose::kSites);
  const auto anywhere = [&] {
    return cv::Point(static_cast<int>(rng.uniform(0, size.width)), static_cast<int>(rng.uniform(0, size.height)));
  };
  cv::Mat1b edges = cv::Mat1b::zeros(size);
  for (int i = 0; i < 1 + seed % 3; ++i) {
    cv::line(edges, anywhere(), anywhere(), 255);
    cv::circle(edges, anywhere(), 5 + static_cast<int>(rng.uniform(0, 60)), 255);
    edges(anywhere()) = 255;
  }
  return edges;
}

// How far heights are from those of the distance transform, as ridges.h promises.
void expect_same_heights(const DistanceField& heights, const DistanceField& expected) {
  ASSERT_EQ(heights.size(), expected.size());
  double sum = 0;
  for (int y = 0; y < heights.rows; ++y)
    for (int x = 0; x < heights.cols; ++x) {
      const double above = heights(y, x) - expected(y, x);
      ASSERT_GT(above, -0.1) << x << ' ' << y;
      ASSERT_LT(above, 0.1 + 0.005 * expected(y, x)) << x << ' ' << y;
      sum += above;
    }
  EXPECT_LE(sum, 0.02 * static_cast<double>(heights.total()));
}

// Mean angle in degrees between the gradients of two fields, where the mountain is no crest or valley: there the
// gradient turns within a pixel, and both of its sides are right.
double mean_angle(const DistanceField& a, const DistanceField& b, int reach) {
  double sum = 0;
  int count = 0;
  for (int y = reach; y < a.rows - reach; ++y)
    for (int x = reach; x < a.cols - reach; ++x) {
      const float far = b(y, x);
      const bool crest = far > std::max(b(y, x - reach), b(y, x + reach)) ||
                         far > std::max(b(y - reach, x), b(y + reach, x)) || far < static_cast<float>(reach);
      if (crest) continue;
      const cv::Vec2d u = uphill(a, x, y, reach), v = uphill(b, x, y, reach);
      if (u.dot(u) == 0 || v.dot(v) == 0) continue;
      sum += std::acos(std::clamp(u.dot(v), -1.0, 1.0)) * 180 / kPi;
      ++count;
    }
  EXPECT_GT(count, static_cast<int>(a.total()) / 4);
  return sum / count;
}

class RidgesParity : public testing::Test {
 protected:
  void SetUp() override {
    Result<GlContext> context = GlContext::create();
    if (!context) GTEST_SKIP() << context.error().message;
    context_.emplace(std::move(*context));
    Result<std::unique_ptr<Rasterizer>> made = make_gl_rasterizer();
    ASSERT_TRUE(made) << made.error().message;
    gl_ = std::move(*made);
  }

  std::optional<GlContext> context_;
  std::unique_ptr<Rasterizer> gl_;  // before the context goes
};

TEST_F(RidgesParity, HeightsAreThoseOfTheDistanceTransform) {
  for (int seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    const cv::Mat1b edges = random_edges({310 - 30 * seed, 170 + 10 * seed}, seed);
    const Result<DistanceField> heights = ridge_distance(edges, *gl_);
    ASSERT_TRUE(heights) << heights.error().message;
    expect_same_heights(*heights, edge_distance(edges));
  }
}

TEST_F(RidgesParity, GradientsAreThoseOfTheDistanceTransform) {
  for (int seed = 0; seed < 6; ++seed) {
    const cv::Mat1b edges = random_edges({240, 200}, 100 + seed);
    const Result<DistanceField> heights = ridge_distance(edges, *gl_);
    ASSERT_TRUE(heights) << heights.error().message;
    EXPECT_LT(mean_angle(*heights, edge_distance(edges), 2), 0.5) << seed;
  }
}

TEST_F(RidgesParity, TheCpuBackendDrawsTheSameMountains) {
  const cv::Mat1b edges = random_edges({200, 150}, 7);
  const Result<DistanceField> drawn = ridge_distance(edges, *gl_),
                              searched = ridge_distance(edges, *make_cpu_rasterizer());
  ASSERT_TRUE(drawn && searched);
  expect_same_heights(*searched, edge_distance(edges));
  expect_same_heights(*drawn, *searched);
}

}  // namespace
}  // namespace tessera
