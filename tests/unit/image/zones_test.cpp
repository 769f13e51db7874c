#include "tessera/image/zones.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/core/utility.hpp>
#include <set>
#include <vector>

#include "tessera/base/portable_math.h"
#include "tessera/base/rng.h"

namespace tessera {
namespace {

cv::Vec3b blend(const cv::Vec3b& outside, const cv::Vec3b& inside, double share) {
  cv::Vec3b colour;
  for (int c = 0; c < 3; ++c)
    colour[c] = static_cast<unsigned char>(std::lround((1 - share) * outside[c] + share * inside[c]));
  return colour;
}

// Lays a shape over a picture, anti-aliased by 16 x 16 samples a pixel.
void lay(cv::Mat3b& picture, const cv::Vec3b& colour, const std::function<bool(double, double)>& inside) {
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      int hits = 0;
      for (int j = 0; j < 16; ++j)
        for (int i = 0; i < 16; ++i) hits += inside(x + (i + 0.5) / 16, y + (j + 0.5) / 16);
      picture(y, x) = blend(picture(y, x), colour, hits / 256.0);
    }
  }
}

std::function<bool(double, double)> disc(double cx, double cy, double radius) {
  return [=](double x, double y) { return std::hypot(x - cx, y - cy) < radius; };
}

// Where the ray from the centre crosses the frontier between zones a and b, by bisection.
double crossing(const Zones& zones, double cx, double cy, double angle, double near, double far, int a, int b) {
  const SinCos turn = sin_cos(angle);
  const auto value = [&](double r) { return zones.frontier(cx + r * turn.cos, cy + r * turn.sin, a, b); };
  if (!(value(near) < 0 && value(far) > 0)) return std::nan("");
  for (int i = 0; i < 40; ++i) (value((near + far) / 2) < 0 ? near : far) = (near + far) / 2;
  return (near + far) / 2;
}

int distance2(Rgb a, const cv::Vec3b& b) {
  const int r = a.r - b[0], g = a.g - b[1], blue = a.b - b[2];
  return r * r + g * g + blue * blue;
}

TEST(BlackAndWhite, FindsTheRimOfADiscToATenthOfAPixel) {
  Rng rng(1, RngPurpose::kNoise);
  for (const double radius : {7.0, 11.3, 20.6}) {
    for (const auto& [ink, paper] : {std::pair{0, 255}, {40, 200}, {10, 90}}) {
      const double cx = 32 + rng.uniform(-1, 1), cy = 32 + rng.uniform(-1, 1);
      cv::Mat3b picture(64, 64, cv::Vec3b::all(static_cast<unsigned char>(paper)));
      lay(picture, cv::Vec3b::all(static_cast<unsigned char>(ink)), disc(cx, cy, radius));
      const Zones zones = black_and_white(picture, 0);
      for (int degrees = 0; degrees < 360; degrees += 7)
        ASSERT_NEAR(crossing(zones, cx, cy, degrees * kPi / 180, radius - 2, radius + 2, 0, 1), radius, 0.1)
            << degrees << " degrees, ink " << ink;
      for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
          const double r = std::hypot(x + 0.5 - cx, y + 0.5 - cy);
          if (std::fabs(r - radius) < 0.75) continue;
          ASSERT_EQ(zones.map(y, x), r > radius) << x << ", " << y;
        }
      }
    }
  }
}

TEST(BlackAndWhite, DividesAtTheGivenThreshold) {
  cv::Mat3b ramp(4, 256);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 256; ++x) ramp(y, x) = cv::Vec3b::all(static_cast<unsigned char>(x));
  for (const double threshold : {0.1, 0.25, 0.5, 0.9, 1.0}) {
    const Zones zones = black_and_white(ramp, threshold);
    EXPECT_NEAR(zones.threshold, 255 * threshold, 1e-9);
    for (int x = 0; x < 256; ++x) ASSERT_EQ(zones.map(1, x), x >= 255 * threshold) << x << " at " << threshold;
  }
}

TEST(BlackAndWhite, ThresholdLiesBetweenTheTwoGreys) {
  for (const auto& [dark, light] : {std::pair{0, 255}, {0, 10}, {200, 255}, {100, 101}}) {
    cv::Mat3b picture(20, 20, cv::Vec3b::all(static_cast<unsigned char>(light)));
    picture(cv::Rect(2, 3, 5, 6)) = cv::Vec3b::all(static_cast<unsigned char>(dark));
    const Zones zones = black_and_white(picture, 0);
    EXPECT_NEAR(zones.threshold, (dark + light) / 2.0, 1e-9);
    EXPECT_EQ(zones.map.total() - cv::countNonZero(zones.map), 30u);
    EXPECT_EQ(zones.map(3, 2), 0);
  }
}

TEST(BlackAndWhite, ColoursCountByTheirRec601Grey) {
  cv::Mat3b picture(1, 2);
  picture(0, 0) = {0, 0, 255};  // blue: grey 29
  picture(0, 1) = {0, 255, 0};  // green: grey 150
  const Zones zones = black_and_white(picture, 0);
  EXPECT_EQ(zones.map(0, 0), 0);
  EXPECT_EQ(zones.map(0, 1), 1);
  EXPECT_NEAR(zones.threshold, (29 + 150) / 2.0, 1);
}

TEST(BlackAndWhite, APictureOfOneColourIsOneZone) {
  for (const int grey : {0, 1, 127, 128, 254, 255}) {
    for (const double threshold : {0.0, 0.5}) {
      const cv::Mat3b picture(5, 7, cv::Vec3b::all(static_cast<unsigned char>(grey)));
      const Zones zones = black_and_white(picture, threshold);
      ASSERT_EQ(zones.map.size(), picture.size());
      ASSERT_EQ(zones.palette.size(), 2u);
      ASSERT_EQ(zones.levels.size(), 2u);
      for (const unsigned char zone : zones.map) EXPECT_EQ(zone, grey > 127);
      EXPECT_TRUE(std::isfinite(zones.frontier(2, 2, 0, 1)));
    }
  }
}

TEST(BlackAndWhite, FrontierSignTellsTheZone) {
  cv::Mat3b picture(16, 16, cv::Vec3b::all(255));
  picture(cv::Rect(0, 0, 8, 16)) = cv::Vec3b::all(0);
  const Zones zones = black_and_white(picture, 0);
  for (double y = 0; y <= 16; y += 1.7) {
    EXPECT_NEAR(zones.frontier(8, y, 0, 1), 0, 0.01);
    EXPECT_NEAR(zones.frontier(2, y, 0, 1), -0.5, 0.01);
    EXPECT_NEAR(zones.frontier(14, y, 0, 1), 0.5, 0.01);
    for (double x = 0; x <= 16; x += 0.3) {
      EXPECT_NEAR(zones.frontier(x, y, 0, 1), -zones.frontier(x, y, 1, 0), 1e-12);
      if (std::fabs(x - 8) < 0.1) continue;
      EXPECT_EQ(zones.frontier(x, y, 0, 1) > 0, x > 8);
    }
  }
}

const cv::Vec3b kFlat[] = {{20, 30, 120}, {230, 220, 40},  {200, 30, 30},
                           {30, 160, 60}, {240, 240, 240}, {10, 10, 10}};

// Quadrants of four colours, discs of others over them.
cv::Mat3b colourful(int colors) {
  cv::Mat3b picture(96, 96, kFlat[0]);
  const std::function<bool(double, double)> shapes[] = {[](double x, double) { return x > 48.3; },
                                                        [](double, double y) { return y > 47.6; }, disc(24, 24, 15.4),
                                                        disc(70.2, 68, 12), disc(71, 25, 14.7)};
  for (int k = 1; k < colors; ++k) lay(picture, kFlat[k], shapes[k - 1]);
  return picture;
}

TEST(ColourZones, FlatColoursAreFoundAgain) {
  for (int colors = 3; colors <= 6; ++colors) {
    const cv::Mat3b picture = colourful(colors);
    const Zones zones = colour_zones(picture, colors);
    ASSERT_EQ(static_cast<int>(zones.palette.size()), colors);
    ASSERT_EQ(static_cast<int>(zones.levels.size()), colors);
    for (int k = 0; k < colors; ++k) {
      int nearest = 1 << 20;
      for (const Rgb colour : zones.palette) nearest = std::min(nearest, distance2(colour, kFlat[k]));
      EXPECT_LE(nearest, 3 * 20 * 20) << "colour " << k << " of " << colors;
    }
    for (int y = 0; y < picture.rows; ++y) {
      for (int x = 0; x < picture.cols; ++x) {
        if (std::count(kFlat, kFlat + colors, picture(y, x)) == 0) continue;  // a blend
        ASSERT_LE(distance2(zones.palette[zones.map(y, x)], picture(y, x)), 3 * 20 * 20) << x << ", " << y;
      }
    }
  }
}

TEST(ColourZones, BlendsAtRimsAreNoZonesOfTheirOwn) {
  // Half way from white to black lies the grey of the third zone.
  cv::Mat3b picture(64, 96, cv::Vec3b::all(255));
  lay(picture, cv::Vec3b::all(0), disc(30.3, 31.8, 20));
  lay(picture, cv::Vec3b::all(119), [](double x, double) { return x > 72; });
  const Zones zones = colour_zones(picture, 3);
  int grey = -1;
  for (int k = 0; k < 3; ++k)
    if (distance2(zones.palette[k], cv::Vec3b::all(119)) < 3 * 20 * 20) grey = k;
  ASSERT_GE(grey, 0);
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < 64; ++x) {
      ASSERT_NE(zones.map(y, x), grey) << x << ", " << y;
      const double r = std::hypot(x + 0.5 - 30.3, y + 0.5 - 31.8);
      if (std::fabs(r - 20) < 1) continue;
      ASSERT_EQ(zones.map(y, x) == zones.map(31, 30), r < 20);
    }
  }
}

TEST(ColourZones, SameZonesOnEveryRunForAnyNumberOfThreads) {
  Rng rng(4, RngPurpose::kNoise);
  cv::Mat3b picture(50, 60);
  for (cv::Vec3b& v : picture)
    v = {static_cast<unsigned char>(rng.bits()), static_cast<unsigned char>(rng.bits()), 90};
  const int threads = cv::getNumThreads();
  const Zones first = colour_zones(picture, 5);
  for (const int n : {1, 2, 4, 4}) {
    cv::setNumThreads(n);
    cv::theRNG().state = 12345u + static_cast<unsigned>(n);  // nobody else's numbers either
    const Zones again = colour_zones(picture, 5);
    EXPECT_EQ(cv::countNonZero(first.map != again.map), 0);
    EXPECT_EQ(first.palette, again.palette);
  }
  cv::setNumThreads(threads);
}

TEST(ColourZones, FewerColoursThanAskedFor) {
  cv::Mat3b picture(12, 12, kFlat[0]);
  picture(cv::Rect(3, 3, 5, 5)) = kFlat[1];
  for (const int colors : {3, 8, 16}) {
    const Zones zones = colour_zones(picture, colors);
    for (int y = 0; y < 12; ++y)
      for (int x = 0; x < 12; ++x)
        ASSERT_LE(distance2(zones.palette[zones.map(y, x)], picture(y, x)), 3 * 5 * 5) << colors << " colours";
  }
  const Zones pixel = colour_zones(cv::Mat3b(1, 1, kFlat[2]), 4);
  EXPECT_LE(distance2(pixel.palette[pixel.map(0, 0)], kFlat[2]), 3 * 5 * 5);
}

TEST(ColourZones, FrontierLiesOnTheEdgeBetweenTwoColours) {
  cv::Mat3b picture(32, 48, kFlat[0]);
  lay(picture, kFlat[1], [](double x, double) { return x > 16.4; });
  lay(picture, kFlat[2], [](double x, double) { return x > 32.7; });
  const Zones zones = colour_zones(picture, 3);
  const int a = zones.map(5, 5), b = zones.map(5, 24), c = zones.map(5, 44);
  for (double y = 2; y < 30; y += 1.3) {
    EXPECT_LT(zones.frontier(12, y, a, b), -0.4);
    EXPECT_GT(zones.frontier(20, y, a, b), 0.4);
    EXPECT_NEAR(crossing(zones, 10, y, 0, 2, 14, a, b), 16.4 - 10, 0.15);
    EXPECT_NEAR(crossing(zones, 25, y, 0, 2, 14, b, c), 32.7 - 25, 0.15);
    EXPECT_NEAR(zones.frontier(16.8, y, a, b), -zones.frontier(16.8, y, b, a), 1e-6);
    EXPECT_NEAR(zones.frontier(40, y, b, c), 0.5, 0.05);
  }
}

}  // namespace
}  // namespace tessera
