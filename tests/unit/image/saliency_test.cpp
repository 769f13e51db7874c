#include "tessera/image/saliency.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tessera/image/lab.h"

namespace tessera {
namespace {

// A light disc on grey. With a share q of the picture covered by colour a and the rest by b, the mean is q a + (1 -
// q) b: the disc is (1 - q) |a - b| from it, the ground q |a - b|.
TEST(Saliency, OfADiscIsThatOfItsShareOfThePicture) {
  cv::Mat3b picture(100, 120, cv::Vec3b(90, 90, 90));
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x)
      if (std::hypot(x - 60, y - 50) < 20) picture(y, x) = {240, 230, 120};
  double inside = 0;
  for (const cv::Vec3b& pixel : picture) inside += pixel[0] == 240;
  const double q = inside / static_cast<double>(picture.total());
  const cv::Mat3b colours = lab_of(cv::Mat3b(1, 2, cv::Vec3b(240, 230, 120)));
  const cv::Mat3b greys = lab_of(cv::Mat3b(1, 2, cv::Vec3b(90, 90, 90)));
  const double apart = cv::norm(cv::Vec3d(colours(0, 0)) - cv::Vec3d(greys(0, 0)));

  const cv::Mat1i saliency = saliency_of(picture);
  EXPECT_NEAR(std::sqrt(saliency(50, 60)), (1 - q) * apart, 0.01 * apart);
  EXPECT_NEAR(std::sqrt(saliency(5, 5)), q * apart, 0.01 * apart);
  EXPECT_NEAR(std::sqrt(saliency(99, 119)), q * apart, 0.01 * apart);  // at the border too
  // The outline stays sharp: three pixels within it all is disc, three outside all is ground.
  EXPECT_EQ(saliency(50, 60 + 16), saliency(50, 60));
  EXPECT_EQ(saliency(50, 60 + 23), saliency(5, 5));
}

TEST(Saliency, OfOneColourIsNone) {
  EXPECT_EQ(cv::countNonZero(saliency_of(cv::Mat3b(7, 9, cv::Vec3b(12, 200, 34)))), 0);
  EXPECT_EQ(saliency_of(cv::Mat3b(1, 1, cv::Vec3b(255, 0, 255)))(0, 0), 0);
}

}  // namespace
}  // namespace tessera
