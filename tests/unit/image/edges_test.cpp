#include "tessera/image/edges.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../mosaic/photos.h"

namespace tessera {
namespace {

using mosaic::paint;

TEST(FindEdges, FollowTheWholeCircleWhateverTheSmoothing) {
  const cv::Mat3b picture = mosaic::disc_photo(300);
  for (const double sigma : {0.8, 2.0, 5.0}) {
    const cv::Mat1b edges = find_edges(picture, {.sigma = sigma, .share = 0.1, .shortest = 20});
    int missing = 0;
    for (int k = 0; k < 360; ++k) {
      const double angle = k * 3.14159265358979 / 180;
      bool found = false;
      for (double r = 0.3 * 300 - 3; r <= 0.3 * 300 + 3; r += 0.5)
        found |= edges(static_cast<int>(150 + r * std::sin(angle)), static_cast<int>(150 + r * std::cos(angle))) != 0;
      missing += !found;
    }
    EXPECT_LE(missing, 4) << "sigma " << sigma;
  }
}

TEST(FindEdges, ThereAreNoneWithoutContrast) {
  EXPECT_EQ(cv::countNonZero(find_edges(mosaic::plain_photo(), {})), 0);
  const cv::Mat3b ramp =
      paint(300, 100, [](double x, double) { return cv::Vec3b::all(static_cast<int>(100 + x / 10)); });
  EXPECT_EQ(cv::countNonZero(find_edges(ramp, {.sigma = 2, .share = 0.1, .shortest = 10})), 0);
}

TEST(FindEdges, SeeColoursOfOneGrey) {
  const cv::Mat3b halves =
      paint(80, 60, [](double x, double) { return x < 40 ? cv::Vec3b(200, 60, 60) : cv::Vec3b(60, 131, 60); });
  EXPECT_GE(cv::countNonZero(find_edges(halves, {.sigma = 1, .share = 0.1, .shortest = 10})), 55);
}

TEST(FindEdges, ShortOnesAreLeftOut) {
  const cv::Mat3b spot = paint(100, 100, [](double x, double y) {
    return std::hypot(x - 50, y - 50) < 3 ? cv::Vec3b::all(0) : cv::Vec3b::all(255);
  });
  EXPECT_GT(cv::countNonZero(find_edges(spot, {.sigma = 1, .share = 0.1, .shortest = 5})), 0);
  EXPECT_EQ(cv::countNonZero(find_edges(spot, {.sigma = 1, .share = 0.1, .shortest = 60})), 0);
}

}  // namespace
}  // namespace tessera
