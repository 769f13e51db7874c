// What holds for the cells of every model, and the closed forms of theirs that a few thousand cells can tell.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tessera/base/portable_math.h"
#include "tessera/patterns/johnson_mehl.h"
#include "tessera/patterns/run.h"
#include "tessera/patterns/voronoi_cells.h"
#include "tessera/points/processes.h"

namespace tessera::patterns {
namespace {

const Model kTessellations[] = {Model::kPoissonLines, Model::kOccupancy, Model::kDelaunay, Model::kJohnsonMehl,
                                Model::kCheckerboard, Model::kHexagon,   Model::kTriangle, Model::kGaussian};
const Model kBombs[] = {Model::kSegments, Model::kEllipses, Model::kCircles, Model::kRectangles, Model::kPixels};

Params params_of(Model model, double width = 230, double height = 170, double size = 14) {
  Params p;
  p.model = model;
  p.width = width;
  p.height = height;
  p.size = size;
  return p;
}

Output made(const Params& params, std::uint64_t seed = 1) {
  auto output = run({}, params, seed, {});
  EXPECT_TRUE(output.has_value());
  return *std::move(output);
}

double total_area(const PieceSheet& sheet) {
  double sum = 0;
  for (const Piece& piece : sheet.pieces) sum += signed_area(piece.outline.outer);
  return sum;
}

// Sides of the outlines, each way; what two cells share is there once in either.
std::map<std::pair<std::pair<double, double>, std::pair<double, double>>, int> sides_of(const PieceSheet& sheet) {
  std::map<std::pair<std::pair<double, double>, std::pair<double, double>>, int> sides;
  for (const Piece& piece : sheet.pieces) {
    const Ring& ring = piece.outline.outer;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i], b = ring[i + 1 < ring.size() ? i + 1 : 0];
      ++sides[{{a.x, a.y}, {b.x, b.y}}];
    }
  }
  return sides;
}

TEST(CellsTest, TileTheWindow) {
  for (const Model model : kTessellations)
    for (std::uint64_t seed = 1; seed <= 25; ++seed) {
      const Output output = made(params_of(model), seed);
      EXPECT_NEAR(total_area(output.sheet) / (230.0 * 170), 1, 1e-9) << static_cast<int>(model) << " " << seed;
    }
}

TEST(CellsTest, TileThePlaneWhereTheyAreSeamless) {
  for (const Model model : kTessellations)
    for (std::uint64_t seed = 1; seed <= 25; ++seed) {
      Params params = params_of(model);
      params.seamless = true;
      const Output output = made(params, seed);
      EXPECT_NEAR(total_area(output.sheet) / (230.0 * 170), 1, 1e-9) << static_cast<int>(model) << " " << seed;
    }
}

TEST(CellsTest, AreSimpleInsideTheWindowAndConvexWhereTheModelIs) {
  for (const Model model : kTessellations)
    for (std::uint64_t seed = 1; seed <= 10; ++seed)
      for (const Piece& piece : made(params_of(model), seed).sheet.pieces) {
        const Ring& ring = piece.outline.outer;
        ASSERT_GT(signed_area(ring), 0);
        ASSERT_TRUE(is_simple(ring)) << static_cast<int>(model) << " " << seed;
        ASSERT_TRUE(model == Model::kJohnsonMehl || is_convex(ring, 1e-6)) << static_cast<int>(model) << " " << seed;
        for (const Point p : ring) {
          ASSERT_TRUE(0 <= p.x && p.x <= 230 && 0 <= p.y && p.y <= 170);
        }
      }
}

// To the last bit: each side inside of the window is another cell's, too, the other way.
TEST(CellsTest, ShareTheirSides) {
  for (const Model model : {Model::kPoissonLines, Model::kOccupancy, Model::kDelaunay, Model::kJohnsonMehl,
                            Model::kCheckerboard, Model::kHexagon, Model::kTriangle})
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const auto sides = sides_of(made(params_of(model), seed).sheet);
      for (const auto& [side, count] : sides) {
        const auto& [a, b] = side;
        const bool on_border = (a.first == b.first && (a.first == 0 || a.first == 230)) ||
                               (a.second == b.second && (a.second == 0 || a.second == 170));
        ASSERT_EQ(count, 1) << static_cast<int>(model) << " " << seed;
        ASSERT_EQ(sides.count({b, a}), on_border ? 0 : 1) << static_cast<int>(model) << " " << seed << ": " << a.first
                                                          << " " << a.second << " to " << b.first << " " << b.second;
      }
    }
}

TEST(CellsTest, ComeInTheNumberThatTheSizeSays) {
  for (const Model model : {Model::kOccupancy, Model::kDelaunay, Model::kJohnsonMehl, Model::kPoissonLines}) {
    double cells = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
      cells += static_cast<double>(made(params_of(model, 800, 800, 16), seed).sheet.pieces.size()) / 20;
    EXPECT_NEAR(cells / 2500, 1, 0.12) << static_cast<int>(model);  // and those that the window cuts
  }
}

// Each place belongs to the point that is nearest.
TEST(VoronoiCellsTest, HoldWhatIsNearestToTheirPoint) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed, RngPurpose::kSites);
    const Window window{{0, 0}, {40, 30}, seed % 2 == 0};
    const auto points = poisson_points(window, 0.05, rng);
    const Cells cells = voronoi_cells(points, window);
    const auto distance = [&](Point p, Point q) {
      Point way = p - q;
      if (window.periodic) way -= Point{40 * std::round(way.x / 40), 30 * std::round(way.y / 30)};
      return length(way);
    };
    for (const Ring& ring : cells) {
      // Where it is in the cell's middle, and a little inside of its corners.
      const Point middle = centroid(ring);
      std::vector<Point> places{middle};
      for (const Point corner : ring) places.push_back(corner + 1e-4 * (middle - corner));
      int owner = -1;
      for (const Point p : places) {
        int nearest = 0;
        for (int i = 1; i < static_cast<int>(points.size()); ++i)
          if (distance(p, points[i]) < distance(p, points[nearest])) nearest = i;
        if (owner < 0) owner = nearest;
        ASSERT_EQ(nearest, owner) << seed;
      }
    }
    EXPECT_EQ(cells.size(), points.size());
  }
}

TEST(VoronoiCellsTest, PartsMakeNoDifference) {
  Rng rng(3, RngPurpose::kSites);
  const Window window{{0, 0}, {600, 500}};
  const double reach = voronoi_reach(1);
  const auto points = poisson_points(window.grown(2 * reach), 1, rng);
  const auto summary = [](const Cells& cells) {
    std::vector<std::pair<double, double>> corners;
    for (const Ring& ring : cells)
      for (const Point p : ring) corners.emplace_back(p.x, p.y);
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  EXPECT_EQ(summary(voronoi_cells(points, window, reach)), summary(voronoi_cells(points, window)));
  EXPECT_EQ(summary(delaunay_cells(points, window, reach)), summary(delaunay_cells(points, window)));
}

TEST(VoronoiCellsTest, DegeneratePoints) {
  const Window window{{0, 0}, {10, 10}};
  EXPECT_TRUE(voronoi_cells({}, window).empty());
  EXPECT_TRUE(voronoi_cells({{1, 1}}, {{0, 0}, {0, 10}}).empty());
  for (const bool periodic : {false, true}) {
    const Window around{{0, 0}, {10, 10}, periodic};
    const auto area_of = [&](const std::vector<Point>& points) {
      double sum = 0;
      for (const Ring& ring : voronoi_cells(points, around)) sum += signed_area(ring);
      return sum;
    };
    EXPECT_NEAR(area_of({{3, 4}}), 100, 1e-7);                          // one point has all
    EXPECT_NEAR(area_of({{3, 4}, {3, 4}, {3, 4}}), 100, 1e-7);          // as have its doubles
    EXPECT_NEAR(area_of({{1, 5}, {3, 5}, {5, 5}, {7, 5}}), 100, 1e-7);  // on a line
    EXPECT_NEAR(area_of({{1, 1}, {2, 2}, {5, 5}, {9, 9}}), 100, 1e-7);  // on a slanting one
    EXPECT_NEAR(area_of({{2, 2}, {2, 8}, {8, 2}, {8, 8}}), 100, 1e-7);  // on a circle
    EXPECT_NEAR(area_of({{0, 0}, {0, 5}, {5, 0}, {5, 5}}), 100, 1e-7);  // on the border
    std::vector<Point> grid;
    for (int i = 0; i < 10; ++i)
      for (int j = 0; j < 10; ++j) grid.push_back({i + 0.5, j + 0.5});
    EXPECT_NEAR(area_of(grid), 100, 1e-7);
  }
  EXPECT_TRUE(delaunay_cells({{1, 1}, {2, 2}}, window).empty());
  EXPECT_TRUE(delaunay_cells({{1, 5}, {3, 5}, {5, 5}}, window).empty());
}

TEST(JohnsonMehlTest, ACellThinnerThanTheToleranceIsNone) {
  const Window window{{-10, -10}, {20, 10}};
  const double rate = 0.01;
  for (const double late : {3.0, 4.9, 4.999, 4.999999}) {
    const std::vector<Nucleus> nuclei = {{{0, 0}, 0}, {{10, 0}, 0}, {{5, 0}, late}};
    const auto cells = johnson_mehl_cells(nuclei, window, rate, 0.01, {});
    ASSERT_TRUE(cells.has_value());
    double area = 0;
    for (const Ring& ring : *cells) {
      EXPECT_GE(ring.size(), 3u);
      area += signed_area(ring);
    }
    EXPECT_NEAR(area, 600, 1e-9);
    EXPECT_EQ(cells->size(), late < 4.99 ? 3u : 2u) << late;
  }
}

TEST(BombsTest, CoverWhatTheClosedFormSays) {
  // The chance that a place is free is exp(-lambda a), whatever the figure.
  for (const Model model : {Model::kEllipses, Model::kCircles, Model::kRectangles, Model::kSegments}) {
    Params params = params_of(model, 200, 200, 12);
    double free = 0, samples = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const Output output = made(params, seed);
      for (int k = 0; k < 100; ++k) {
        const Point p{20.0 * (k % 10) + 10, 20.0 * (k / 10) + 10};
        bool covered = false;
        for (const Piece& piece : output.sheet.pieces) {
          const Ring& ring = piece.outline.outer;
          bool inside = true;
          for (std::size_t i = 0; i < ring.size() && inside; ++i)
            inside = cross(ring[(i + 1) % ring.size()] - ring[i], p - ring[i]) >= 0;
          covered = covered || inside;
        }
        free += covered ? 0 : 1;
        ++samples;
      }
    }
    const double area = signed_area(made(params).sheet.pieces[0].outline.outer);
    const double expected = std::exp(-area / 144);
    EXPECT_NEAR(free / samples, expected, 3.5 * std::sqrt(expected * (1 - expected) / samples))
        << static_cast<int>(model);
  }
}

TEST(BombsTest, HaveTheAreaOfTheFigure) {
  const auto area = [](Model model) {
    return signed_area(made(params_of(model, 200, 200, 12)).sheet.pieces.at(0).outline.outer);
  };
  EXPECT_NEAR(area(Model::kCircles), kPi * 100, 1e-6);
  EXPECT_NEAR(area(Model::kEllipses), kPi * 10 * 4, 1e-6);
  EXPECT_NEAR(area(Model::kRectangles), 160, 1e-6);
  EXPECT_NEAR(area(Model::kSegments), 60, 1e-6);
  EXPECT_NEAR(area(Model::kPixels), 1, 1e-9);
}

TEST(PatternTest, SameSeedSamePattern) {
  for (const Model model : kTessellations) {
    const Output a = made(params_of(model), 5), b = made(params_of(model), 5), c = made(params_of(model), 6);
    ASSERT_EQ(a.areas, b.areas);
    EXPECT_TRUE(model == Model::kGaussian || a.areas != c.areas || sides_of(a.sheet) != sides_of(c.sheet));
  }
  for (const Model model : kBombs) EXPECT_EQ(made(params_of(model), 5).areas, made(params_of(model), 5).areas);
}

TEST(PatternTest, AnIntensityOfZeroMakesNothing) {
  for (const Model model :
       {Model::kOccupancy, Model::kDelaunay, Model::kJohnsonMehl, Model::kCircles, Model::kPoints}) {
    Params params = params_of(model);
    params.intensity = 0;
    std::string warning;
    RunContext context;
    context.on_warning = [&](std::string_view text) { warning = text; };
    const auto output = run({}, params, 1, context);
    ASSERT_TRUE(output.has_value());
    EXPECT_TRUE(output->sheet.pieces.empty());
    EXPECT_THAT(warning, testing::HasSubstr("empty"));
  }
  Params none = params_of(Model::kPoissonLines);  // without lines the window is one cell
  none.intensity = 0;
  EXPECT_EQ(made(none).sheet.pieces.size(), 1u);
}

TEST(PatternTest, BordersAreAsThickAsAsked) {
  for (const Model model : {Model::kHexagon, Model::kCheckerboard}) {
    Params params = params_of(model, 400, 400, 40);
    params.border = 4;
    const double inner = total_area(made(params).sheet) / 160000;
    // Of a distance of 20 or 34.64 from a cell's middle to its sides 2 are the border's.
    EXPECT_NEAR(inner, model == Model::kHexagon ? 0.888 : 0.81, 0.01);
    for (const Piece& piece : made(params).sheet.pieces)
      for (const Point p : piece.outline.outer) ASSERT_TRUE(0 <= p.x && p.x <= 400 && 0 <= p.y && p.y <= 400);
  }
}

TEST(PatternTest, RefusesMoreThanMemoryHolds) {
  Params params = params_of(Model::kOccupancy, 65536, 65536, 0.5);
  const auto by_size = run({}, params, 1, {});
  ASSERT_FALSE(by_size.has_value());
  EXPECT_EQ(by_size.error().field, "size");
  params.intensity = 1e6;
  EXPECT_EQ(run({}, params, 1, {}).error().field, "intensity");
}

TEST(PatternTest, StopsWhenAsked) {
  const std::atomic<int> stop{static_cast<int>(StopReason::kCancelled)};
  RunContext context;
  context.stop = &stop;
  const auto output = run({}, params_of(Model::kJohnsonMehl), 1, context);
  ASSERT_FALSE(output.has_value());
  EXPECT_EQ(output.error().code, StatusCode::kCancelled);
}

}  // namespace
}  // namespace tessera::patterns
