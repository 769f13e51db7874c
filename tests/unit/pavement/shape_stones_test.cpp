// Corners, straightening and separate stones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diagrams.h"
#include "tessera/geometry/polygon.h"
#include "tessera/pavement/paper_stones.h"
#include "tessera/pavement/place_vertices.h"
#include "tessera/tessellation/match_corners.h"
#include "tessera/tessellation/relax.h"
#include "tessera/tessellation/separate.h"

namespace tessera::pavement {
namespace {

struct Shaped {
  Prepared prepared;
  Params params;
  Tessellation placed, relaxed;
  std::vector<char> matched, flat;  // before and after relaxing
};

template <class Check>
void for_shaped(const Check& check) {
  for (const NamedDrawing& drawing : all_drawings()) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      Shaped s;
      s.params.iterations = 8;
      s.params.colors = drawing.colors;
      s.prepared = prepare(drawing.picture, s.params, seed);
      s.placed = place_vertices(s.prepared.diagram, s.prepared.fields);
      s.matched = s.flat = match_corners(s.placed);
      s.relaxed = s.placed;
      relax(s.relaxed, s.flat, [&](int v, Point p) { return back_to_frontier(s.placed, s.prepared.fields, v, p); });
      check(drawing.name, s);
    }
  }
}

TEST(MatchCorners, LeavesEveryStoneFourCornersAndEveryVertexOneFlatSide) {
  for_shaped([](const std::string& name, const Shaped& s) {
    const PlanarMap& map = s.placed.map;
    ASSERT_EQ(s.matched.size(), map.ring.size());
    std::vector<int> flat_at(map.vertices.size(), 0);
    for (int cell = 0; cell < map.cells(); ++cell) {
      int corners = 0;
      for (int slot = map.first[cell]; slot < map.first[cell + 1]; ++slot) {
        corners += !s.matched[slot];
        flat_at[map.ring[slot]] += s.matched[slot];
      }
      EXPECT_GE(corners, std::min(4, map.corners(cell))) << name << ", cell " << cell;
    }
    for (const int n : flat_at) EXPECT_LE(n, 1) << name;
  });
}

TEST(MatchCorners, MostStonesOfAPlainPictureHaveFourCorners) {
  Params params;
  const Prepared p = prepare(flat_drawing(160, 160, 255), params, 1);
  const Tessellation t = place_vertices(p.diagram, p.fields);
  const auto flat = match_corners(t);
  int four = 0;
  for (int cell = 0; cell < t.cells(); ++cell)
    four += std::count(flat.begin() + t.map.first[cell], flat.begin() + t.map.first[cell + 1], 0) == 4;
  EXPECT_GT(four, 0.8 * t.cells());
}

TEST(Relax, MovesVerticesOnlyAsTheyMay) {
  for_shaped([](const std::string& name, const Shaped& s) {
    const Zones& zones = s.prepared.fields.zones;
    ASSERT_EQ(s.relaxed.map.ring, s.placed.map.ring);
    ASSERT_EQ(s.relaxed.map.first, s.placed.map.first);
    for (std::size_t v = 0; v < s.placed.map.vertices.size(); ++v) {
      const Point before = s.placed.map.vertices[v], after = s.relaxed.map.vertices[v];
      ASSERT_TRUE(std::isfinite(after.x) && std::isfinite(after.y)) << name;
      switch (s.placed.freedom[v]) {
        case Freedom::kFixed: EXPECT_EQ(before, after) << name; break;
        case Freedom::kBorder: EXPECT_LT(std::fabs(dot(after - before, s.placed.normal[v])), 1e-9) << name; break;
        case Freedom::kFrontier: {
          const auto [a, b] = s.placed.between[v];
          EXPECT_LT(std::fabs(zones.frontier(after.x, after.y, a, b)), 0.1)
              << name << ": " << before.x << ", " << before.y << " to " << after.x << ", " << after.y;
          break;
        }
        case Freedom::kFree: break;
      }
    }
  });
}

TEST(Relax, OnlyTakesFlatSidesBack) {
  for_shaped([](const std::string& name, const Shaped& s) {
    ASSERT_EQ(s.flat.size(), s.matched.size());
    for (std::size_t i = 0; i < s.flat.size(); ++i) EXPECT_LE(s.flat[i], s.matched[i]) << name;
  });
}

TEST(Relax, MakesFlatSidesStraighter) {
  Params params;
  const Prepared p = prepare(flat_drawing(120, 120, 255), params, 2);
  Tessellation t = place_vertices(p.diagram, p.fields);
  auto flat = match_corners(t);
  const auto off = [&] {
    double sum = 0;
    for (int cell = 0; cell < t.cells(); ++cell) {
      for (int slot = t.map.first[cell]; slot < t.map.first[cell + 1]; ++slot) {
        if (!flat[slot]) continue;
        const Point a = t.map.at(t.map.previous(cell, slot)), b = t.map.at(t.map.next(cell, slot));
        sum += std::fabs(cross(b - a, t.map.at(slot) - a)) / length(b - a);
      }
    }
    return sum;
  };
  const double before = off();
  relax(t, flat, [&](int v, Point q) { return back_to_frontier(t, p.fields, v, q); });
  EXPECT_LT(off(), 0.2 * before);
}

TEST(SeparatePieces, KeepFourCornersAndStayWithinTheirCells) {
  for_shaped([](const std::string& name, const Shaped& s) {
    const auto stones = separate_pieces(s.relaxed, s.flat, s.params.wide_angle);
    const PlanarMap& map = s.relaxed.map;
    ASSERT_EQ(static_cast<int>(stones.size()), map.cells());
    for (int cell = 0; cell < map.cells(); ++cell) {
      EXPECT_TRUE(stones[cell].empty() || stones[cell].size() >= 4) << name << ", cell " << cell;
      Point least{1e9, 1e9}, most{-1e9, -1e9};
      for (int slot = map.first[cell]; slot < map.first[cell + 1]; ++slot) {
        const Point p = map.at(slot);
        least = {std::min(least.x, p.x), std::min(least.y, p.y)};
        most = {std::max(most.x, p.x), std::max(most.y, p.y)};
      }
      for (const Point p : stones[cell])
        EXPECT_TRUE(p.x >= least.x && p.y >= least.y && p.x <= most.x && p.y <= most.y) << name << ", cell " << cell;
    }
  });
}

Ring random_star(Rng& rng) {
  Ring ring;
  const int n = 3 + static_cast<int>(rng.bits() % 6);
  const double stretch = rng.uniform(0.1, 1);
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979 * (i + rng.uniform(0, 0.8)) / n, r = rng.uniform(1, 5);
    ring.push_back({20 + r * std::cos(angle), 30 + stretch * r * std::sin(angle)});
  }
  return ring;
}

TEST(Shrink, MovesVerticesTowardsTheCentreAndNeverPastIt) {
  Rng rng(3, RngPurpose::kShapes);
  for (int i = 0; i < 3000; ++i) {
    const Ring whole = random_star(rng);
    if (!is_simple(whole)) continue;
    const double grout = i % 4 == 0 ? 1000 : rng.uniform(0, 8), half_side = rng.uniform(1, 6);
    Ring ring = whole;
    shrink(ring, grout, half_side);
    ASSERT_EQ(ring.size(), whole.size());
    const Point centre = centroid(whole);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point before = whole[k] - centre, after = ring[k] - centre;
      ASSERT_LE(length(ring[k] - whole[k]), grout / 2 + 1e-9);
      ASSERT_GE(dot(before, after), 0);
      ASSERT_LE(length(after), length(before) + 1e-9);
      ASSERT_LT(std::fabs(cross(before, after)), 1e-9 * (1 + dot(before, before)));
    }
    ASSERT_TRUE(is_simple(ring));
    ASSERT_GT(signed_area(ring) * signed_area(whole), 0);
  }
}

TEST(Shrink, ALargeStoneGivesHalfTheGroutAtEveryCorner) {
  Ring square = {{0, 0}, {20, 0}, {20, 20}, {0, 20}};
  shrink(square, 1, 5);
  EXPECT_NEAR(length(square[0]), 0.5, 1e-12);
  EXPECT_NEAR(square[0].x, square[0].y, 1e-12);
}

TEST(Shrink, WithoutGroutNothingMoves) {
  const Ring whole = {{0, 0}, {8, 1}, {9, 7}, {1, 8}};
  Ring ring = whole;
  shrink(ring, 0, 4);
  EXPECT_EQ(ring, whole);
}

TEST(Shrink, WhatHasNoAreaIsLeftAlone) {
  for (const Ring& whole : {Ring{}, Ring{{1, 1}}, Ring{{1, 1}, {1, 1}, {1, 1}}, Ring{{0, 0}, {4, 0}, {2, 0}}}) {
    Ring ring = whole;
    shrink(ring, 1, 4);
    ASSERT_EQ(ring.size(), whole.size());
    for (const Point p : ring) EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
  }
}

TEST(PaperStones, OneRingACellOfFiniteVertices) {
  for (const NamedDrawing& drawing : all_drawings()) {
    Params params;
    params.iterations = 8;
    params.colors = drawing.colors;
    const Prepared p = prepare(drawing.picture, params, 1);
    const PaperStones stones = paper_stones(p.diagram, p.fields, params);
    ASSERT_EQ(static_cast<int>(stones.rings.size()), p.diagram.cells) << drawing.name;
    ASSERT_EQ(stones.vertices_before.size(), stones.rings.size());
    for (std::size_t cell = 0; cell < stones.rings.size(); ++cell) {
      const auto& ring = stones.rings[cell];
      EXPECT_LE(static_cast<int>(ring.size()), stones.vertices_before[cell]);
      EXPECT_GE(static_cast<int>(ring.size()), std::min(4, stones.vertices_before[cell]));
      for (const Point q : ring) ASSERT_TRUE(std::isfinite(q.x) && std::isfinite(q.y)) << drawing.name;
    }
  }
}

}  // namespace
}  // namespace tessera::pavement
