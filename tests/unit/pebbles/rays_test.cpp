// The paper's segmenter: levels, hysteresis, rays, slices.
#include "tessera/pebbles/rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>
#include <utility>
#include <vector>

#include "labels.h"
#include "tessera/base/portable_math.h"
#include "tessera/pebbles/level_edges.h"
#include "tessera/pebbles/segment_rays.h"
#include "tessera/pebbles/slice.h"

namespace tessera::pebbles {
namespace {

// Steps, slopes and noise.
cv::Mat1b textured(int width, int height, std::uint64_t seed) {
  Rng rng(seed, RngPurpose::kNoise);
  cv::Mat1b picture(height, width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) picture(y, x) = static_cast<std::uint8_t>(std::min(255, 3 * x + below(rng, 40)));
  for (int k = 0; k < 12; ++k)
    cv::circle(picture, {below(rng, width), below(rng, height)}, 2 + below(rng, 12), cv::Scalar(below(rng, 256)), -1);
  return picture;
}

// Eq. 2 for each level i / L on its own: a neighbour reaches it, the pixel is below tau = parts / 64 of it.
int levels_that_see_a_change(const cv::Mat1b& picture, int y, int x, int parts) {
  int count = 0;
  for (int i = 1; i <= kLevels; ++i) {
    if (kLevels * 64 * picture(y, x) >= parts * i * 255) continue;
    bool reached = false;
    for (const auto& [v, u] : {std::pair{y - 1, x}, {y + 1, x}, {y, x - 1}, {y, x + 1}})
      reached |= v >= 0 && u >= 0 && v < picture.rows && u < picture.cols && kLevels * picture(v, u) >= i * 255;
    count += reached ? 1 : 0;
  }
  return count;
}

TEST(LevelEdges, ChangesAreThoseOfTheLoopOverTheLevels) {
  for (const int parts : {64, 58, 54, 32, 5})
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const cv::Mat1b picture = textured(60, 40, seed);
      const cv::Mat1w changes = level_changes(picture, parts / 64.0);
      for (int y = 0; y < picture.rows; ++y)
        for (int x = 0; x < picture.cols; ++x)
          ASSERT_EQ(changes(y, x), levels_that_see_a_change(picture, y, x, parts)) << parts << ' ' << y << ' ' << x;
    }
}

TEST(LevelEdges, TheQuartileIsOfThePixelsThatChange) {
  cv::Mat1w changes(10, 10, std::uint16_t{0});
  EXPECT_EQ(first_quartile(changes), 0);
  for (int k = 0; k < 8; ++k) changes(k, 3) = static_cast<std::uint16_t>(10 * (k + 1));
  EXPECT_EQ(first_quartile(changes), 20);
}

TEST(LevelEdges, HysteresisIsWhatStrongPixelsReach) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng(seed, RngPurpose::kNoise);
    cv::Mat1w changes(24, 31);
    for (std::uint16_t& c : changes)
      c = static_cast<std::uint16_t>(below(rng, 3) == 0 ? below(rng, 12) : below(rng, 3));
    const int high = 1 + below(rng, 12);
    cv::Mat1b expected = changes >= high, before;
    const cv::Mat1b possible = (3 * changes >= high) & (changes > 0);
    do {
      expected.copyTo(before);
      cv::dilate(expected, expected, cv::Mat1b(3, 3, std::uint8_t{1}));
      expected = expected & possible;
    } while (cv::countNonZero(expected != before) > 0);
    EXPECT_EQ(cv::countNonZero(hysteresis(changes, high) != expected), 0) << seed;
  }
}

TEST(LevelEdges, ThereAreNoneOnPlainPictures) {
  EXPECT_EQ(cv::countNonZero(level_edges(cv::Mat3b(30, 40, cv::Vec3b(90, 80, 70)), 2, 0.85)), 0);
  EXPECT_EQ(cv::countNonZero(level_edges(cv::Mat3b(30, 40, cv::Vec3b(0, 0, 0)), 0, 1)), 0);
}

cv::Mat1b random_mask(int width, int height, int one_in, std::uint64_t seed) {
  Rng rng(seed, RngPurpose::kNoise);
  cv::Mat1b mask(height, width);
  for (std::uint8_t& m : mask) m = below(rng, one_in) == 0 ? 255 : 0;
  return mask;
}

TEST(Mask, KnowsTheDistanceToWhatIsNotFree) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    cv::Mat1b edges = random_mask(23, 17, 60, seed);
    Mask mask(edges);
    std::vector<cv::Point> filled;
    for (int k = 0; k < 12; ++k) filled.emplace_back(5 + k % 4, 6 + k / 4);
    mask.fill(filled);
    for (const cv::Point p : filled) edges(p) = 255;
    for (int y = 0; y < edges.rows; ++y)
      for (int x = 0; x < edges.cols; ++x) {
        int least = std::min(std::min(x, y) + 1, std::min(edges.cols - x, edges.rows - y));
        for (int v = 0; v < edges.rows; ++v)
          for (int u = 0; u < edges.cols; ++u)
            if (edges(v, u) != 0) least = std::min(least, std::abs(v - y) + std::abs(u - x));
        ASSERT_EQ(mask.distance({x, y}), least) << seed << ' ' << x << ' ' << y;
      }
  }
}

TEST(Mask, RaysEndAtTheFirstPixelThatIsNotFree) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const cv::Mat1b edges = random_mask(64, 48, 150, seed);
    const Mask mask(edges);
    const cv::Point from{20 + static_cast<int>(seed), 22};
    if (!mask.free(from)) continue;
    const auto hits = mask.hits(from);
    for (int k = 0; k < kRays; ++k) {
      const SinCos way = sin_cos(2 * kPi * k / kRays);
      const Point to{hits[k].x - from.x + 0.0, hits[k].y - from.y + 0.0};
      EXPECT_LE(std::fabs(cross({way.cos, way.sin}, to)), 0.75) << k;
      EXPECT_GT(dot({way.cos, way.sin}, to), 0) << k;
      EXPECT_FALSE(mask.free(hits[k])) << k;
      // No pixel well inside the way is an edge.
      for (double t = 0; t < length(to) - 1.5; t += 0.25) {
        const double x = from.x + 0.5 + t * way.cos, y = from.y + 0.5 + t * way.sin;
        const double off = std::max(std::fabs(x - std::floor(x) - 0.5), std::fabs(y - std::floor(y) - 0.5));
        if (off < 0.2) {
          EXPECT_EQ(edges(static_cast<int>(y), static_cast<int>(x)), 0) << k << ' ' << t;
        }
      }
    }
  }
}

TEST(Mask, AnEightConnectedRingHoldsTheRays) {
  for (int radius = 3; radius < 30; ++radius) {
    cv::Mat1b edges(70, 70, std::uint8_t{0});
    cv::circle(edges, {35, 35}, radius, 255, 1, cv::LINE_8);
    for (const cv::Point hit : Mask(edges).hits({35, 35}))
      EXPECT_NEAR(std::hypot(hit.x - 35, hit.y - 35), radius, 1.5) << radius;
  }
}

// The outline of an ellipse but for the directions from `gap` on, as wide as `gap_width`.
cv::Mat1b ellipse_edges(cv::Size size, cv::Point centre, cv::Size axes, int turn, int gap, int gap_width) {
  cv::Mat1b edges(size, std::uint8_t{0});
  cv::ellipse(edges, centre, axes, turn, gap + gap_width, gap + 360, 255);
  return edges;
}

double overlap(const cv::Mat& a, const cv::Mat& b) {
  return static_cast<double>(cv::countNonZero(a & b)) / std::max(1, cv::countNonZero(a | b));
}

TEST(Rays, AnEllipseWithAGapIsFound) {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    Rng rng(seed, RngPurpose::kShapes);
    const int longer = 20 + below(rng, 60), shorter = longer * (60 + below(rng, 41)) / 100;
    const cv::Size size(240, 220);
    const cv::Point centre{100 + below(rng, 40), 90 + below(rng, 40)};
    const int turn = below(rng, 180), gap = below(rng, 360), gap_width = 5 + below(rng, 36);
    cv::Mat1b edges = ellipse_edges(size, centre, {longer, shorter}, turn, gap, gap_width);
    cv::rectangle(edges, {10, 10, 220, 200}, 255, 2);  // what lies around: rays through the gap end there
    const std::optional<Slice> slice = find_slice(Mask(edges), centre + cv::Point(shorter / 3, -shorter / 4));
    ASSERT_TRUE(slice) << seed;
    cv::Mat1b truth(size, std::uint8_t{0}), found(size, std::uint8_t{0});
    cv::ellipse(truth, centre, {longer, shorter}, turn, 0, 360, 255, -1);
    std::vector<cv::Point> ring;
    for (const Point p : outline(slice->shape)) ring.emplace_back(cvFloor(p.x), cvFloor(p.y));
    cv::fillPoly(found, std::vector<std::vector<cv::Point>>{ring}, 255);
    EXPECT_GT(overlap(truth, found), 0.9) << seed << ": " << longer << ' ' << shorter << ' ' << gap_width;
  }
}

TEST(Rays, GapsInACircleAreFilledWithItsArc) {
  for (const int open : {20, 60, 100}) {
    std::vector<Vertex> vertices;
    bool gap = false;
    for (int k = 0; k < 360; k += 5) {
      gap |= k > 0 && k < open;
      if (k > 0 && k < open) continue;
      const SinCos turn = sin_cos(kPi * k / 180);
      vertices.push_back({{100 * turn.cos, 100 * turn.sin}, gap});
      gap = false;
    }
    const Ring ring = closed(vertices);
    EXPECT_EQ(ring.size(), vertices.size() + 5);
    for (const Point p : ring) EXPECT_NEAR(length(p), 100, 2.5) << open;
    EXPECT_NEAR(signed_area(ring) / (kPi * 10000), 1, 0.02) << open;
  }
}

TEST(Rays, NoSliceWhereNothingStopsThem) {
  EXPECT_FALSE(find_slice(Mask(cv::Mat1b(40, 60, std::uint8_t{0})), {30, 20}));
  const auto labels = slices_of(cv::Mat1b(40, 60, std::uint8_t{0}), {});
  ASSERT_TRUE(labels);
  EXPECT_EQ(cv::countNonZero(*labels), 0);
}

// Light discs on dark ground, all alike: a quarter of the edges, the weakest, is none.
cv::Mat3b discs(int columns, int rows, int pitch, int radius) {
  cv::Mat3b picture(rows * pitch, columns * pitch, cv::Vec3b(40, 40, 40));
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      cv::circle(picture, {c * pitch + pitch / 2, r * pitch + pitch / 2}, radius, cv::Scalar(150, 160, 170), -1);
  return picture;
}

TEST(Rays, DiscsBetweenWhichAllIsEdgeAreCounted) {
  for (const int radius : {5, 9, 17}) {
    cv::Mat1b edges(200, 240, std::uint8_t{255});
    for (int r = 0; r < 5; ++r)
      for (int c = 0; c < 6; ++c) cv::circle(edges, {c * 40 + 20, r * 40 + 20}, radius, 0, -1);
    const auto labels = slices_of(edges, {});
    ASSERT_TRUE(labels);
    EXPECT_EQ(std::set<int>(labels->begin(), labels->end()).size(), 31u) << radius;
    EXPECT_GT(overlap(*labels > 0, edges == 0), 0.85) << radius;
  }
}

int count_of(const cv::Mat1i& labels) {
  return static_cast<int>(std::set<int>(labels.begin(), labels.end()).size()) - 1;
}

TEST(Rays, EveryDiscOfAGridIsFoundOnce) {
  for (const int radius : {8, 14, 18}) {
    const cv::Mat3b picture = discs(6, 5, 40, radius);
    const auto labels = segment_by_rays(picture, {}, {});
    ASSERT_TRUE(labels);
    std::set<int> seen;
    for (int r = 0; r < 5; ++r)
      for (int c = 0; c < 6; ++c) {
        const int label = (*labels)(r * 40 + 20, c * 40 + 20);
        EXPECT_GT(label, 0) << radius << ' ' << r << ' ' << c;
        EXPECT_TRUE(seen.insert(label).second) << radius << ' ' << r << ' ' << c;
        cv::Mat1b truth(picture.rows, picture.cols, std::uint8_t{0});
        cv::circle(truth, {c * 40 + 20, r * 40 + 20}, radius, 255, -1);
        EXPECT_GT(overlap(*labels == label, truth), 0.8) << radius << ' ' << r << ' ' << c;
      }
  }
}

TEST(Rays, PicturesWithoutPebblesComeToAnEnd) {
  Params params;
  params.contrast = 0;
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(3, 2), cv::Size(200, 1), cv::Size(90, 70)}) {
    const auto plain = segment_by_rays(cv::Mat3b(size, cv::Vec3b(128, 128, 128)), params, {});
    ASSERT_TRUE(plain);
    EXPECT_EQ(cv::countNonZero(*plain), 0);
    Rng rng(size.area(), RngPurpose::kNoise);
    cv::Mat3b noise(size);
    for (cv::Vec3b& pixel : noise) pixel = cv::Vec3b::all(static_cast<std::uint8_t>(rng.bits()));
    const auto labels = segment_by_rays(noise, params, {});
    ASSERT_TRUE(labels);
    EXPECT_EQ(labels->size(), size);
  }
}

TEST(Rays, NoPixelsOfASliceAreApart) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const auto labels = slices_of(random_mask(120, 90, 25 + 20 * static_cast<int>(seed), seed), {});
    ASSERT_TRUE(labels);
    EXPECT_GT(count_of(*labels), 3);
    const std::set<int> all(labels->begin(), labels->end());
    for (const int label : all)
      if (label > 0) {
        cv::Mat1i parts;
        EXPECT_EQ(cv::connectedComponents(*labels == label, parts, 4), 2) << seed << ' ' << label;
      }
  }
}

TEST(Rays, StopWhenToldTo) {
  const std::atomic<int> stop{static_cast<int>(StopReason::kCancelled)};
  RunContext context;
  context.stop = &stop;
  const auto labels = slices_of(random_mask(120, 90, 30, 1), context);
  ASSERT_FALSE(labels);
  EXPECT_EQ(labels.error().code, StatusCode::kCancelled);
}

}  // namespace
}  // namespace tessera::pebbles
