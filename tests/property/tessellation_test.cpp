// What must hold of corners and straightening, whatever cells they are given: here a wall of bricks, shaken.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

#include "tessera/base/rng.h"
#include "tessera/tessellation/match_corners.h"
#include "tessera/tessellation/relax.h"
#include "tessera/tessellation/separate.h"

namespace tessera {
namespace {

constexpr int kRows = 14, kColumns = 14;
constexpr double kBrick = 10;

// Bricks of six vertices, every second row half a brick further; those within are moved by up to `shake`.
Tessellation wall(std::uint64_t seed, double shake) {
  Tessellation t;
  std::map<std::pair<int, int>, int> known, uses;
  std::vector<std::pair<int, int>> place;
  const auto vertex = [&](int half_column, int row) {
    const auto [entry, fresh] = known.insert({{half_column, row}, static_cast<int>(place.size())});
    if (fresh) place.push_back({half_column, row});
    ++uses[{half_column, row}];
    return entry->second;
  };
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const int left = 2 * column + row % 2;
      for (const int k : {left, left + 1, left + 2}) t.map.ring.push_back(vertex(k, row));
      for (const int k : {left + 2, left + 1, left}) t.map.ring.push_back(vertex(k, row + 1));
      t.map.first.push_back(static_cast<int>(t.map.ring.size()));
    }
  t.set_vertices(place.size());
  Rng rng(seed, RngPurpose::kSites);
  for (std::size_t v = 0; v < place.size(); ++v) {
    const bool inside = uses[place[v]] == 3;
    t.freedom[v] = inside ? Freedom::kFree : Freedom::kFixed;
    t.map.vertices[v] = {0.5 * kBrick * place[v].first, kBrick * place[v].second};
    if (inside) t.map.vertices[v] += Point{rng.uniform(-shake, shake), rng.uniform(-shake, shake)};
  }
  t.zone.assign(t.cells(), 0);
  t.half_side.assign(t.cells(), static_cast<float>(0.5 * kBrick));
  t.frame.assign(t.cells(), {1, 0});
  return t;
}

double area_of(const Tessellation& t) {
  double sum = 0;
  for (int cell = 0; cell < t.cells(); ++cell) {
    Ring ring;
    for (int slot = t.map.first[cell]; slot < t.map.first[cell + 1]; ++slot) ring.push_back(t.map.at(slot));
    sum += signed_area(ring);
  }
  return sum;
}

TEST(TessellationProperty, AVertexIsFlatForOneCellAndNoCellHasFewerThanFourCorners) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Tessellation t = wall(seed, 0.25 * static_cast<double>(seed));
    const std::vector<char> flat = match_corners(t);
    ASSERT_EQ(flat.size(), t.map.ring.size());
    std::vector<int> owners(t.map.vertices.size(), 0);
    int four = 0;
    for (int cell = 0; cell < t.cells(); ++cell) {
      int corners = 0;
      for (int slot = t.map.first[cell]; slot < t.map.first[cell + 1]; ++slot) {
        corners += !flat[slot];
        owners[t.map.ring[slot]] += flat[slot];
      }
      EXPECT_GE(corners, 4) << seed;
      four += corners == 4;
    }
    for (const int n : owners) EXPECT_LE(n, 1) << seed;
    EXPECT_GE(four, (kRows - 2) * (kColumns - 2) * 9 / 10) << seed;  // bricks at the wall's border have less choice
  }
}

TEST(TessellationProperty, PiecesAreOutlinesThatShareTheWholeArea) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Tessellation t = wall(seed, 0.25 * static_cast<double>(seed));
    const double whole = area_of(t);
    std::vector<char> flat = match_corners(t);
    relax(t, flat, [](int, Point p) { return p; }, {.rounds = 60, .gap = 0.004, .overlap = 0.0003});
    EXPECT_NEAR(area_of(t), whole, 1e-6 * whole) << seed;
    double sum = 0;
    for (const Ring& piece : separate_pieces(t, flat, 180)) {
      EXPECT_GE(piece.size(), 4u) << seed;
      EXPECT_TRUE(is_simple(piece)) << seed;
      EXPECT_GT(signed_area(piece), 0) << seed;
      sum += signed_area(piece);
    }
    EXPECT_NEAR(sum, whole, 0.01 * whole) << seed;
  }
}

TEST(TessellationProperty, AWallOfRectanglesStaysOne) {
  Tessellation t = wall(1, 0);
  const std::vector<Point> before = t.map.vertices;
  std::vector<char> flat = match_corners(t);
  relax(t, flat, [](int, Point p) { return p; });
  for (std::size_t v = 0; v < before.size(); ++v) EXPECT_LT(length(t.map.vertices[v] - before[v]), 1e-9) << v;
}

}  // namespace
}  // namespace tessera
