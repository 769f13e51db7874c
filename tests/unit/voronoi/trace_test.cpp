#include "tessera/voronoi/trace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include "label_maps.h"
#include "tessera/voronoi/cells.h"

namespace tessera {
namespace {

int label_at(const LabelMap& labels, cv::Point p) {
  return p.x < 0 || p.y < 0 || p.x >= labels.cols || p.y >= labels.rows ? kOutside : labels(p);
}

// The pixels left and right of the pixel side that goes from one corner to the next.
std::pair<int, int> beside(const LabelMap& labels, cv::Point from, cv::Point to) {
  const cv::Point way = to - from;
  if (way.x != 0) {
    const int x = std::min(from.x, to.x), upper = label_at(labels, {x, from.y - 1}),
              lower = label_at(labels, {x, from.y});
    return way.x > 0 ? std::pair{upper, lower} : std::pair{lower, upper};
  }
  const int y = std::min(from.y, to.y), left = label_at(labels, {from.x - 1, y}),
            right = label_at(labels, {from.x, y});
  return way.y > 0 ? std::pair{right, left} : std::pair{left, right};
}

// Pixel sides between different labels, the picture's border among them.
int count_sides(const LabelMap& labels) {
  int sides = 0;
  for (int y = 0; y <= labels.rows; ++y) {
    for (int x = 0; x <= labels.cols; ++x) {
      const int here = label_at(labels, {x, y});
      sides += here != label_at(labels, {x - 1, y});
      sides += here != label_at(labels, {x, y - 1});
    }
  }
  return sides;
}

double twice_area(const std::vector<cv::Point>& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const cv::Point a = corners[i], b = corners[(i + 1) % corners.size()];
    sum += static_cast<double>(a.x) * b.y - static_cast<double>(a.y) * b.x;
  }
  return sum;
}

std::vector<cv::Point> corners_of(const CellGraph& graph, const LabelMap& labels, std::span<const int> ring) {
  std::vector<cv::Point> corners;
  for (const int h : ring) {
    std::vector<cv::Point> walk = walk_arc(graph, labels, h >> 1);
    if (h & 1) std::reverse(walk.begin(), walk.end());
    corners.insert(corners.end(), walk.begin(), walk.end() - 1);
  }
  return corners;
}

// Whether something lies within the cell that is not of it and has no way out. Where a cell touches itself at a
// corner, there is none.
bool encloses(const LabelMap& labels, int cell) {
  cv::Mat1b seen(labels.rows + 2, labels.cols + 2, static_cast<unsigned char>(0));
  std::vector<cv::Point> open{{-1, -1}};
  seen(0, 0) = 1;
  for (std::size_t i = 0; i < open.size(); ++i) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const cv::Point q = open[i] + cv::Point(dx, dy);
        if (dx != 0 && dy != 0) continue;
        if (q.x < -1 || q.y < -1 || q.x > labels.cols || q.y > labels.rows || seen(q + cv::Point(1, 1))) continue;
        if (label_at(labels, q) == cell) continue;
        seen(q + cv::Point(1, 1)) = 1;
        open.push_back(q);
      }
    }
  }
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x)
      if (labels(y, x) != cell && !seen(y + 1, x + 1)) return true;
  return false;
}

bool any_encloses(const LabelMap& labels, int cells) {
  for (int cell = 0; cell < cells; ++cell)
    if (encloses(labels, cell)) return true;
  return false;
}

std::vector<int> pixel_counts(const LabelMap& labels, int cells) {
  std::vector<int> counts(cells, 0);
  for (const int l : labels) ++counts[l];
  return counts;
}

struct Case {
  cv::Mat1b zones;
  LabelMap labels;
  int cells;
};

// Connected cells of ragged outline: a Voronoi diagram with noise, mended.
Case random_case(int seed) {
  Rng rng(static_cast<std::uint64_t>(seed), RngPurpose::kSites);
  const int width = 1 + below(rng, 36), height = 1 + below(rng, 28);  // compilers differ in the order of arguments
  const cv::Size size(width, height);
  Case c{random_zones(size, 1 + seed % 3, rng), LabelMap(size), 1 + below(rng, 25)};
  std::vector<cv::Point> sites(c.cells);
  for (cv::Point& p : sites) p = {below(rng, size.width), below(rng, size.height)};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      int best = kUnlabelled, least = 1 << 30;
      for (int k = 0; k < c.cells; ++k) {
        const int dx = sites[k].x - x, dy = sites[k].y - y, d = dx * dx + dy * dy + below(rng, seed % 4 * 30 + 1);
        if (c.zones(sites[k]) != c.zones(y, x) || d >= least) continue;
        least = d;
        best = k;
      }
      c.labels(y, x) = best;
    }
  }
  c.cells = connect_cells(c.labels, c.zones, c.cells);
  return c;
}

Case opened_case(int seed) {
  Case c = random_case(seed);
  open_enclosures(c.labels, c.zones, c.cells);
  return c;
}

constexpr int kSeeds = 150;

TEST(Trace, EverySideBetweenTwoLabelsLiesOnOneArc) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    const Case c = opened_case(seed);
    const CellGraph graph = trace_cells(c.labels);
    std::set<std::tuple<int, int, int, int>> sides;
    for (int k = 0; k < static_cast<int>(graph.arcs.size()); ++k) {
      const Arc& arc = graph.arcs[k];
      const auto walk = walk_arc(graph, c.labels, k);
      ASSERT_EQ(static_cast<int>(walk.size()), arc.length + 1);
      ASSERT_EQ(walk.front(), cv::Point(graph.junctions[arc.from].x, graph.junctions[arc.from].y));
      ASSERT_EQ(walk.back(), cv::Point(graph.junctions[arc.to].x, graph.junctions[arc.to].y));
      for (std::size_t i = 1; i < walk.size(); ++i) {
        ASSERT_EQ(beside(c.labels, walk[i - 1], walk[i]), std::pair(arc.left, arc.right));
        const auto [a, b] = std::minmax({std::pair(walk[i - 1].x, walk[i - 1].y), std::pair(walk[i].x, walk[i].y)});
        ASSERT_TRUE(sides.insert({a.first, a.second, b.first, b.second}).second)
            << "a side on two arcs, seed " << seed;
      }
    }
    ASSERT_EQ(static_cast<int>(sides.size()), count_sides(c.labels)) << "seed " << seed;
  }
}

TEST(Trace, JunctionsAreWhereThreeLabelsMeetOrThePictureTurns) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    const Case c = random_case(seed);
    const CellGraph graph = trace_cells(c.labels);
    std::map<std::pair<int, int>, const Junction*> at;
    for (const Junction& j : graph.junctions) ASSERT_TRUE(at.insert({{j.y, j.x}, &j}).second);
    for (int y = 0; y <= c.labels.rows; ++y) {
      for (int x = 0; x <= c.labels.cols; ++x) {
        const cv::Point p(x, y), ways[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
        int degree = 0;
        for (const cv::Point way : ways) {
          const auto [left, right] = beside(c.labels, p, p + way);
          degree += left != right;
        }
        const bool corner = (x == 0 || x == c.labels.cols) && (y == 0 || y == c.labels.rows);
        const auto found = at.find({y, x});
        ASSERT_EQ(found != at.end(), degree >= 3 || corner) << "seed " << seed << " at " << x << ", " << y;
        if (found == at.end()) continue;
        int leaving = 0;
        for (int d = 0; d < 4; ++d) {
          const auto [left, right] = beside(c.labels, p, p + ways[d]);
          const int h = found->second->half_edges[d];
          ASSERT_EQ(h >= 0, left != right);
          if (h < 0) continue;
          ++leaving;
          ASSERT_EQ(&graph.junctions[graph.tail(h)], found->second);
          ASSERT_EQ(graph.label_left(h), left);
          ASSERT_EQ(graph.label_right(h), right);
        }
        ASSERT_EQ(leaving, degree);
      }
    }
    ASSERT_TRUE(std::is_sorted(graph.junctions.begin(), graph.junctions.end(), [](const auto& a, const auto& b) {
      return std::pair(a.y, a.x) < std::pair(b.y, b.x);
    }));
  }
}

TEST(Trace, RingsAreClosedAndHoldTheirPixels) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    const Case c = opened_case(seed);
    const CellGraph graph = trace_cells(c.labels);
    std::vector<int> enclosing;
    const auto rings = cell_rings(graph, c.cells, enclosing);
    EXPECT_TRUE(enclosing.empty()) << "seed " << seed;
    ASSERT_EQ(rings.cells(), c.cells);
    const auto counts = pixel_counts(c.labels, c.cells);
    for (int cell = 0; cell < c.cells; ++cell) {
      if (counts[cell] == 0) {
        ASSERT_TRUE(rings[cell].empty());
        continue;
      }
      const auto ring = rings[cell];
      ASSERT_FALSE(ring.empty()) << "seed " << seed << ", cell " << cell;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        ASSERT_EQ(graph.label_right(ring[i]), cell);
        ASSERT_EQ(graph.head(ring[i]), graph.tail(ring[(i + 1) % ring.size()]));
      }
      ASSERT_EQ(twice_area(corners_of(graph, c.labels, ring)), 2 * counts[cell])
          << "seed " << seed << ", cell " << cell;
    }
  }
}

TEST(Trace, ASingleCellIsThePicturesOutline) {
  for (const cv::Size& size : {cv::Size{1, 1}, {1, 5}, {6, 4}}) {
    const LabelMap labels(size, 0);
    const CellGraph graph = trace_cells(labels);
    EXPECT_EQ(graph.junctions.size(), 4u);
    EXPECT_EQ(graph.arcs.size(), 4u);
    std::vector<int> enclosing;
    const auto rings = cell_rings(graph, 1, enclosing);
    ASSERT_EQ(rings[0].size(), 4u);
    EXPECT_EQ(twice_area(corners_of(graph, labels, rings[0])), 2 * size.area());
    EXPECT_TRUE(enclosing.empty());
  }
}

TEST(Trace, TwoCellsShareOneArc) {
  const LabelMap labels = labels_of({"aab", "aab"});
  const CellGraph graph = trace_cells(labels);
  EXPECT_EQ(graph.junctions.size(), 6u);
  EXPECT_EQ(graph.arcs.size(), 7u);
  int shared = 0;
  for (const Arc& arc : graph.arcs) {
    if (std::min(arc.left, arc.right) < 0) continue;
    ++shared;
    EXPECT_EQ(arc.length, 2);
    EXPECT_EQ(std::minmax(arc.left, arc.right), std::minmax(0, 1));
  }
  EXPECT_EQ(shared, 1);
}

TEST(Trace, FourQuadrantsMeetInOneJunction) {
  const CellGraph graph = trace_cells(labels_of({"aabb", "aabb", "ccdd", "ccdd"}));
  EXPECT_EQ(graph.junctions.size(), 9u);
  EXPECT_EQ(graph.arcs.size(), 12u);
  const auto middle = std::find_if(graph.junctions.begin(), graph.junctions.end(),
                                   [](const Junction& j) { return j.x == 2 && j.y == 2; });
  ASSERT_NE(middle, graph.junctions.end());
  EXPECT_EQ(middle->labels, (std::array<int, 4>{0, 1, 3, 2}));
  for (const int h : middle->half_edges) EXPECT_GE(h, 0);
}

TEST(Trace, AJunctionOfThree) {
  const CellGraph graph = trace_cells(labels_of({"aaaa", "aaaa", "bbcc", "bbcc"}));
  const auto middle = std::find_if(graph.junctions.begin(), graph.junctions.end(),
                                   [](const Junction& j) { return j.x == 2 && j.y == 2; });
  ASSERT_NE(middle, graph.junctions.end());
  EXPECT_LT(middle->half_edges[3], 0);  // north: a on both sides
  EXPECT_EQ(std::count_if(middle->half_edges.begin(), middle->half_edges.end(), [](int h) { return h >= 0; }), 3);
  EXPECT_EQ(graph.junctions.size(), 8u);
  EXPECT_EQ(graph.arcs.size(), 10u);
}

TEST(Trace, ACellThatTouchesItselfAtACornerKeepsOneRing) {
  const LabelMap labels = labels_of({"aab", "aca", "aaa"});
  const CellGraph graph = trace_cells(labels);
  std::vector<int> enclosing;
  const auto rings = cell_rings(graph, 3, enclosing);
  EXPECT_TRUE(enclosing.empty());
  EXPECT_EQ(twice_area(corners_of(graph, labels, rings[0])), 2 * 7);
}

TEST(Trace, CellsThatEncloseOthersAreNamed) {
  // b and c are islands that share a junction; a goes around them.
  const LabelMap labels = labels_of({"aaaa", "abca", "aaaa"});
  const CellGraph graph = trace_cells(labels);
  std::vector<int> enclosing;
  const auto rings = cell_rings(graph, 3, enclosing);
  EXPECT_EQ(enclosing, std::vector<int>{0});
  EXPECT_EQ(rings[0].size(), 4u);
  EXPECT_EQ(twice_area(corners_of(graph, labels, rings[0])), 2 * 12);
}

void expect_opened(const LabelMap& before, const cv::Mat1b& zones, int cells) {
  LabelMap labels = before.clone();
  int now = cells;
  open_enclosures(labels, zones, now);
  ASSERT_GE(now, cells);
  EXPECT_FALSE(any_encloses(labels, now));
  std::set<int> seen;
  for (const Part& part : parts_of(labels, zones)) {
    ASSERT_TRUE(part.label >= 0 && part.label < now);
    ASSERT_TRUE(seen.insert(part.label).second) << "label " << part.label << " has two parts or crosses zones";
  }
  EXPECT_TRUE(any_encloses(before, cells) || same_labels(before, labels));
}

cv::Mat1b one_zone(const LabelMap& labels) { return cv::Mat1b::zeros(labels.size()); }

TEST(OpenEnclosures, AnIslandWithinACell) {
  const LabelMap labels = labels_of({"aaaaa", "aabba", "aabba", "aaaaa"});
  expect_opened(labels, one_zone(labels), 2);
}

TEST(OpenEnclosures, AnIslandOfAnotherZone) {
  const LabelMap labels = labels_of({"aaaaa", "aabba", "aabba", "aaaaa"});
  expect_opened(labels, cv::Mat1b(labels == 1), 2);
}

TEST(OpenEnclosures, IslandsOfOnePixel) {
  for (const LabelMap& labels :
       {labels_of({"aaa", "aba", "aaa"}), labels_of({"aaaaa", "abaca", "aaaaa", "adaea", "aaaaa"})})
    expect_opened(labels, cv::Mat1b(labels != 0), 5);
}

TEST(OpenEnclosures, TwoIslandsThatTouch) {
  const LabelMap labels = labels_of({"aaaaa", "abbca", "abcca", "aaaaa"});
  expect_opened(labels, one_zone(labels), 3);
}

TEST(OpenEnclosures, RingsWithinRings) {
  const LabelMap labels = labels_of({"aaaaaaa", "abbbbba", "abcccba", "abcdcba", "abcccba", "abbbbba", "aaaaaaa"});
  expect_opened(labels, one_zone(labels), 4);
  expect_opened(labels, cv::Mat1b((labels == 0) | (labels == 2)), 4);
}

TEST(OpenEnclosures, ManyIslandsInOneCell) {
  for (const int side : {9, 21, 41}) {
    LabelMap labels(side, side, 0);
    int cells = 1;
    for (int y = 1; y < side; y += 2)
      for (int x = 1; x < side; x += 2) labels(y, x) = cells++;
    expect_opened(labels, cv::Mat1b(labels != 0), cells);
  }
}

TEST(OpenEnclosures, ScatteredIslandsInOneCell) {
  for (int seed = 0; seed < 20; ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed), RngPurpose::kSites);
    LabelMap labels(32, 32, 0);
    for (int& l : labels) l = below(rng, 12) == 0 ? 1 : 0;
    const cv::Mat1b zones(labels != 0);
    const int cells = connect_cells(labels, zones, 2);
    expect_opened(labels, zones, cells);
  }
}

TEST(OpenEnclosures, RandomMaps) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    const Case c = random_case(seed);
    expect_opened(c.labels, c.zones, c.cells);
  }
}

}  // namespace
}  // namespace tessera
