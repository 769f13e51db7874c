#include "tessera/image/bilateral.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tessera/base/rng.h"

namespace tessera {
namespace {

cv::Mat1b noise(Rng& rng, cv::Size size, int around, int by) {
  cv::Mat1b picture(size);
  for (std::uint8_t& level : picture)
    level = static_cast<std::uint8_t>(around + std::floor(rng.uniform(-by, by + 1)));
  return picture;
}

// As the papers write it.
double mean_at(const cv::Mat1b& picture, const cv::Mat1b& guide, cv::Point at, const BilateralParams& params) {
  double sum = 0, weights = 0;
  const int reach = std::max(1, static_cast<int>(std::ceil(2 * params.sigma_px)));
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx) {
      if (dx * dx + dy * dy > reach * reach) continue;
      const int x = std::clamp(at.x + dx, 0, picture.cols - 1), y = std::clamp(at.y + dy, 0, picture.rows - 1);
      const double off = guide(y, x) - guide(at);
      const double weight = std::exp(-(dx * dx + dy * dy) / (2 * params.sigma_px * params.sigma_px)) *
                            std::exp(-off * off / (2 * params.sigma_levels * params.sigma_levels));
      sum += weight * picture(y, x);
      weights += weight;
    }
  return sum / weights;
}

TEST(JointBilateral, IsTheMeanThatItsAuthorsGive) {
  Rng rng(1, RngPurpose::kNoise);
  for (int seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    const cv::Size size(3 + 5 * seed % 31, 2 + 7 * seed % 29);
    const cv::Mat1b picture = noise(rng, size, 120, 10 + 10 * seed);
    const cv::Mat1b guide = seed % 2 == 0 ? picture : noise(rng, size, 100, 60);
    const BilateralParams params{0.8 + 0.3 * seed, 10.0 + 5 * seed};
    const cv::Mat1b smooth = joint_bilateral(picture, guide, params);
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x)
        EXPECT_NEAR(smooth(y, x), mean_at(picture, guide, {x, y}, params), 0.5 + 0.01 * 130);
  }
}

TEST(RollingGuidance, DropsWhatIsSmallAndKeepsEdges) {
  Rng rng(2, RngPurpose::kNoise);
  cv::Mat1b picture = noise(rng, {60, 60}, 60, 8);
  picture.colRange(30, 60) += 120;
  for (int dot = 0; dot < 4; ++dot) picture(cv::Rect(4 + 14 * (dot % 2), 12 + 30 * (dot / 2), 2, 2)).setTo(200);
  const cv::Mat1b smooth = rolling_guidance(picture, {3, 25}, 4);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 24; ++x) EXPECT_NEAR(smooth(y, x), 60, 14) << x << ' ' << y;
    EXPECT_GT(smooth(y, 31) - smooth(y, 28), 90) << y;
  }
}

TEST(RollingGuidance, IsTheSameForAnyNumberOfThreads) {
  Rng rng(3, RngPurpose::kNoise);
  const cv::Mat1b picture = noise(rng, {71, 53}, 128, 100);
  cv::setNumThreads(1);
  const cv::Mat1b one = rolling_guidance(picture, {2, 30}, 3);
  cv::setNumThreads(4);
  const cv::Mat1b four = rolling_guidance(picture, {2, 30}, 3);
  cv::setNumThreads(-1);
  EXPECT_EQ(cv::countNonZero(one != four), 0);
}

}  // namespace
}  // namespace tessera
