// Pictures at other sizes.
#include "tessera/image/resample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../image_views.h"
#include "tessera/base/rng.h"

namespace tessera {
namespace {

cv::Mat3b noise(int width, int height, std::uint64_t seed) {
  Rng rng(seed, RngPurpose::kNoise);
  cv::Mat3b picture(height, width);
  for (cv::Vec3b& p : picture)
    for (int c = 0; c < 3; ++c) p[c] = static_cast<std::uint8_t>(rng.bits());
  return picture;
}

// Mean of the source over the area [x, x + 1) x [y, y + 1) of a picture of `size`.
double mean_under(const cv::Mat3b& source, cv::Size size, int x, int y, int c) {
  const double wide = static_cast<double>(source.cols) / size.width,
               high = static_cast<double>(source.rows) / size.height;
  double sum = 0;
  for (int v = 0; v < source.rows; ++v)
    for (int u = 0; u < source.cols; ++u) {
      const double along = std::min((x + 1) * wide, u + 1.0) - std::max<double>(x * wide, u),
                   across = std::min((y + 1) * high, v + 1.0) - std::max<double>(y * high, v);
      if (along > 0 && across > 0) sum += along * across * source(v, u)[c];
    }
  return sum / (wide * high);
}

TEST(Shrunk, PixelsAreTheMeansOfTheirAreas) {
  for (const cv::Size from : {cv::Size(30, 20), cv::Size(31, 17), cv::Size(64, 9)})
    for (const int width : {1, 7, 13, 29}) {
      const cv::Mat3b source = noise(from.width, from.height, static_cast<std::uint64_t>(width));
      const cv::Mat3b small = shrunk(view_of(source), width);
      ASSERT_EQ(small.cols, width);
      ASSERT_EQ(small.rows, std::max(1, static_cast<int>(std::lround(1.0 * from.height * width / from.width))));
      for (int y = 0; y < small.rows; ++y)
        for (int x = 0; x < small.cols; ++x)
          for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(small(y, x)[c], mean_under(source, small.size(), x, y, c), 0.75) << from << width;
    }
}

TEST(Shrunk, TheMeanStays) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const cv::Mat3b source = noise(200, 150, seed);
    const cv::Scalar before = cv::mean(source),
                     after = cv::mean(shrunk(view_of(source), 40 + 23 * static_cast<int>(seed)));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(before[c], after[c], 0.15) << seed;
  }
}

TEST(Shrunk, PlainPicturesStayPlain) {
  for (const int level : {0, 1, 128, 254, 255})
    for (const int width : {3, 10, 36}) {
      const cv::Mat3b source(23, 37, cv::Vec3b::all(static_cast<std::uint8_t>(level)));
      for (const cv::Vec3b& p : shrunk(view_of(source), width)) ASSERT_EQ(p, source(0, 0)) << level << ' ' << width;
    }
}

TEST(Shrunk, CopiesWhatIsNoWider) {
  cv::Mat3b source = noise(12, 9, 1);
  for (const int width : {12, 13, 900}) {
    const cv::Mat3b copy = shrunk(view_of(source), width);
    ASSERT_EQ(copy.size(), source.size());
    EXPECT_TRUE(std::equal(copy.begin(), copy.end(), source.begin()));
    EXPECT_NE(copy.ptr(), source.ptr());
  }
}

TEST(Shrunk, ReadsRowsByTheirStride) {
  const cv::Mat3b wide = noise(50, 20, 2);
  const cv::Mat3b part = wide(cv::Rect(7, 3, 30, 12)), packed = part.clone();
  const cv::Mat3b a = shrunk(view_of(part), 11), b = shrunk(view_of(packed), 11);
  EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
}

TEST(Resampled, PixelsAreAsLargeAsAsked) {
  // 5 / 3 source pixels each; the last one reaches beyond the picture, which goes on as it ends.
  const cv::Mat3b source = noise(17, 11, 4);
  const cv::Mat3b out = resampled(view_of(source), {5, 3}, {5, 3}, {11, 7});
  const auto at = [&](int x, int y, int c) {
    return static_cast<double>(source(std::min(y, 10), std::min(x, 16))[c]);
  };
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 11; ++x)
      for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (int v = 0; v < 25; ++v)
          for (int u = 0; u < 25; ++u) sum += at((5 * x + u / 5) / 3, (5 * y + v / 5) / 3, c);
        ASSERT_NEAR(out(y, x)[c], sum / 625, 1.0) << x << ' ' << y;
      }
}

TEST(Resampled, FinerThanTheSource) {
  const cv::Mat3b source = noise(5, 4, 9);
  const cv::Mat3b out = resampled(view_of(source), {1, 2}, {1, 2}, {10, 8});
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 10; ++x) ASSERT_EQ(out(y, x), source(y / 2, x / 2));
}

}  // namespace
}  // namespace tessera
