#include "tessera/voronoi/smooth_outlines.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "label_maps.h"
#include "tessera/base/portable_math.h"
#include "tessera/geometry/scan.h"
#include "tessera/voronoi/cells.h"

namespace tessera {
namespace {

// The cells of a few sites, with some islands in them; connected, and none touches itself at a corner.
LabelMap random_cells(Rng& rng, int& cells) {
  const int width = 20 + below(rng, 60), height = 20 + below(rng, 60), sites = 1 + below(rng, 12);
  std::vector<cv::Point> places;
  for (int i = 0; i < sites; ++i) places.emplace_back(below(rng, width), below(rng, height));
  LabelMap labels(height, width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      int best = 0;
      const auto squared = [&](int i) { return (cv::Point(x, y) - places[i]).dot(cv::Point(x, y) - places[i]); };
      for (int i = 1; i < sites; ++i)
        if (squared(i) < squared(best)) best = i;
      labels(y, x) = best;
    }
  cells = sites;
  for (int i = below(rng, 4); i > 0; --i) {
    const cv::Rect island(2 + below(rng, width - 10), 2 + below(rng, height - 10), 2 + below(rng, 6),
                          2 + below(rng, 6));
    labels(island).setTo(cells++);
  }
  const cv::Mat1b zones(labels.size(), static_cast<unsigned char>(0));
  for (int round = 0; round < 5; ++round) {
    part_corners(labels);
    cells = connect_cells(labels, zones, cells);
  }
  part_corners(labels);
  return labels;
}

using Place = std::pair<double, double>;

void count_sides(const Ring& ring, std::map<std::pair<Place, Place>, int>& sides) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], b = ring[i + 1 < ring.size() ? i + 1 : 0];
    ++sides[{{a.x, a.y}, {b.x, b.y}}];
  }
}

TEST(SmoothOutlines, TileThePictureWithSharedSides) {
  int holes = 0;
  for (int seed = 1; seed <= 150; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed, RngPurpose::kShapes);
    int cells = 0;
    const LabelMap labels = random_cells(rng, cells);
    const std::vector<Polygon> outlines = smooth_outlines(labels, cells, rng.uniform(0.3, 3));
    double sum = 0;
    cv::Mat1i covered(labels.size(), 0);
    std::map<std::pair<Place, Place>, int> sides;
    for (int cell = 0; cell < cells; ++cell) {
      if (cv::countNonZero(labels == cell) == 0) continue;
      const Polygon& outline = outlines[cell];
      ASSERT_GT(signed_area(outline.outer), 0);
      EXPECT_TRUE(is_simple(outline.outer));
      sum += area(outline);
      count_sides(outline.outer, sides);
      for (const Ring& hole : outline.holes) {
        ++holes;
        EXPECT_LT(signed_area(hole), 0);
        EXPECT_TRUE(is_simple(hole));
        count_sides(hole, sides);
      }
      each_run(outline, labels.cols, labels.rows, [&](int y, int begin, int end) {
        for (int x = begin; x < end; ++x) ++covered(y, x);
      });
    }
    EXPECT_NEAR(sum, static_cast<double>(labels.total()), 1e-6);
    EXPECT_EQ(cv::countNonZero(covered != 1), 0);
    const auto on_border = [&](const Place& a, const Place& b) {
      return (a.first == b.first && (a.first == 0 || a.first == labels.cols)) ||
             (a.second == b.second && (a.second == 0 || a.second == labels.rows));
    };
    for (const auto& [side, count] : sides) {
      EXPECT_EQ(count, 1);
      EXPECT_TRUE(on_border(side.first, side.second) || sides.count({side.second, side.first}) == 1);
    }
  }
  EXPECT_GT(holes, 20);
}

TEST(SmoothOutlines, StairsGoAndCornersStay) {
  LabelMap disc(120, 120, 0), slope(60, 100, 0), square(60, 60, 0);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x)
      if (length(Point{x + 0.5, y + 0.5} - Point{60, 60}) < 45) disc(y, x) = 1;
  const Ring round = smooth_outlines(disc, 2, 0.75)[1].outer;
  for (const Point p : round) EXPECT_NEAR(length(p - Point{60, 60}), 45, 1.5);
  EXPECT_NEAR(perimeter(round), 2 * kPi * 45, 0.02 * 2 * kPi * 45);  // of pixels: 8 * 45
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 100; ++x) slope(y, x) = x + 0.5 > 20 + 0.7 * y;
  EXPECT_LE(smooth_outlines(slope, 2, 0.75)[0].outer.size(), 8U);  // but at its ends, which stay
  square(cv::Rect(20, 15, 20, 25)).setTo(1);
  EXPECT_NEAR(area(smooth_outlines(square, 2, 0.75)[1]), 500, 1e-9);
}

TEST(SmoothOutlines, APixelAmongOthersKeepsItsShape) {
  LabelMap labels = labels_of({"aaaa", "abca", "aaaa"});
  const std::vector<Polygon> outlines = smooth_outlines(labels, 3, 5);
  EXPECT_NEAR(area(outlines[1]), 1, 1e-9);
  EXPECT_NEAR(area(outlines[2]), 1, 1e-9);
  EXPECT_NEAR(area(outlines[0]), 10, 1e-9);
  EXPECT_EQ(outlines[0].holes.size(), 1U);
}

TEST(PartCorners, NoneIsLeft) {
  for (int seed = 1; seed <= 60; ++seed) {
    Rng rng(seed, RngPurpose::kShapes);
    LabelMap labels(30, 30);
    for (int& label : labels) label = below(rng, 2 + seed % 4);
    part_corners(labels);
    for (int y = 0; y + 1 < 30; ++y)
      for (int x = 0; x + 1 < 30; ++x) {
        const int a = labels(y, x), b = labels(y, x + 1), c = labels(y + 1, x), d = labels(y + 1, x + 1);
        EXPECT_FALSE(a == d && a != b && a != c) << seed;
        EXPECT_FALSE(b == c && b != a && b != d) << seed;
      }
  }
}

}  // namespace
}  // namespace tessera
