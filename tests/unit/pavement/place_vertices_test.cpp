#include "tessera/pavement/place_vertices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "diagrams.h"
#include "tessera/base/portable_math.h"
#include "tessera/geometry/polygon.h"

namespace tessera::pavement {
namespace {

Params quick() {
  Params params;
  params.iterations = 6;
  return params;
}

// Calls check(name, prepared, tessellation) for all drawings and some seeds.
template <class Check>
void for_tessellations(const Check& check) {
  for (const NamedDrawing& drawing : all_drawings()) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      Params params = quick();
      params.colors = drawing.colors;
      const Prepared p = prepare(drawing.picture, params, seed);
      check(drawing.name, p, place_vertices(p.diagram, p.fields));
    }
  }
}

Ring ring_of(const PlanarMap& map, int cell) {
  Ring ring;
  for (int slot = map.first[cell]; slot < map.first[cell + 1]; ++slot) ring.push_back(map.at(slot));
  return ring;
}

TEST(ToFrontier, FindsTheRimOfADisc) {
  const cv::Mat3b picture = disc_drawing(80);
  const Zones zones = black_and_white(picture, 0);
  Rng rng(1, RngPurpose::kSites);
  for (int i = 0; i < 500; ++i) {
    const SinCos turn = sin_cos(rng.uniform(0, 2 * kPi));
    const double radius = 0.31 * 80 + rng.uniform(-1, 1);
    const Point centre{0.52 * 80, 0.47 * 80}, start = centre + radius * Point{turn.cos, turn.sin};
    Point p = start;
    ASSERT_TRUE(to_frontier(zones, 0, 1, 1.5, p));
    EXPECT_NEAR(length(p - centre), 0.31 * 80, 0.15);
    EXPECT_LE(length(p - start), 1.5);
    EXPECT_LT(std::fabs(zones.frontier(p.x, p.y, 0, 1)), 0.02);
  }
}

TEST(ToFrontier, LeavesThePointWhereThereIsNoFrontier) {
  const Zones zones = black_and_white(disc_drawing(80), 0);
  for (const Point start : {Point{5, 5}, Point{41, 37}, Point{0, 79.5}}) {
    Point p = start;
    EXPECT_FALSE(to_frontier(zones, 0, 1, 1.5, p));
    EXPECT_EQ(p, start);
  }
}

TEST(PlaceVertices, TilesThePictureBetweenThem) {
  for_tessellations([](const std::string& name, const Prepared& p, const Tessellation& t) {
    double sum = 0;
    for (int cell = 0; cell < t.cells(); ++cell) sum += signed_area(ring_of(t.map, cell));
    EXPECT_NEAR(sum, static_cast<double>(p.diagram.labels.total()), 1e-6 * p.diagram.labels.total()) << name;
  });
}

TEST(PlaceVertices, RingsHaveFourVerticesAndNoneTwice) {
  for_tessellations([](const std::string& name, const Prepared& p, const Tessellation& t) {
    ASSERT_EQ(t.cells(), p.diagram.cells) << name;
    std::vector<char> occupied(t.cells(), 0);
    for (const int label : p.diagram.labels) occupied[label] = 1;
    for (int cell = 0; cell < t.cells(); ++cell) {
      if (!occupied[cell]) continue;
      ASSERT_GE(t.map.corners(cell), 4) << name << ", cell " << cell;
      std::set<int> seen;
      for (int slot = t.map.first[cell]; slot < t.map.first[cell + 1]; ++slot) seen.insert(t.map.ring[slot]);
      EXPECT_EQ(static_cast<int>(seen.size()), t.map.corners(cell)) << name << ", cell " << cell;
    }
  });
}

TEST(PlaceVertices, VerticesAreSharedAndStayInThePicture) {
  for_tessellations([](const std::string& name, const Prepared& p, const Tessellation& t) {
    const std::size_t n = t.map.vertices.size();
    ASSERT_EQ(t.freedom.size(), n);
    ASSERT_EQ(t.normal.size(), n);
    ASSERT_EQ(t.between.size(), n);
    const double width = p.diagram.labels.cols, height = p.diagram.labels.rows;
    std::vector<int> uses(n, 0);
    for (const int v : t.map.ring) ++uses[v];
    for (std::size_t v = 0; v < n; ++v) {
      const Point q = t.map.vertices[v];
      ASSERT_TRUE(q.x >= 0 && q.y >= 0 && q.x <= width && q.y <= height) << name << ": " << q.x << ", " << q.y;
      const bool rim = q.x == 0 || q.y == 0 || q.x == width || q.y == height;
      EXPECT_GE(uses[v], rim ? 1 : 2) << name << ": " << q.x << ", " << q.y;
      const double normal = length(t.normal[v]);
      EXPECT_TRUE(normal == 0 || std::fabs(normal - 1) < 1e-9) << name;
      if (t.freedom[v] == Freedom::kBorder) {
        EXPECT_TRUE(rim) << name;
      }
      if (t.freedom[v] == Freedom::kFrontier) {
        EXPECT_LT(std::fabs(p.fields.zones.frontier(q.x, q.y, t.between[v][0], t.between[v][1])), 0.1) << name;
      }
    }
  });
}

}  // namespace
}  // namespace tessera::pavement
