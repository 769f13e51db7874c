#include "tessera/parquetry/morphed_patches.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "drawn_targets.h"
#include "tessera/geometry/inscribed.h"
#include "tessera/geometry/narrow.h"
#include "tessera/parquetry/pieces.h"
#include "tessera/parquetry/state.h"

namespace tessera::parquetry {
namespace {

using ::testing::HasSubstr;

std::vector<Patch> patches_for(const cv::Mat3b& target, const Params& params) {
  auto patches = morphed_patches(target, params, kMm);
  EXPECT_TRUE(patches) << (patches ? "" : patches.error().message);
  return patches ? *patches : std::vector<Patch>{};
}

TEST(MorphedPatches, TileTheTargetAndAreWideEnough) {
  Rng rng(1, RngPurpose::kShapes);
  for (int seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE(seed);
    Params params = morphed();
    params.min_width_mm = 3 + seed % 6;
    params.attraction = 1 + seed % 9;
    const cv::Size size(kCell * (1 + seed % 7) + seed, kCell * (1 + seed % 5));
    const cv::Mat3b target = shapes(rng, size, 2 + seed % 8);
    double sum = 0;
    cv::Mat1b covered(size, static_cast<std::uint8_t>(0));
    for (const Patch& patch : patches_for(target, params)) {
      const Ring& ring = patch.outline.outer;
      EXPECT_TRUE(is_simple(ring));
      EXPECT_GT(signed_area(ring), 0);
      sum += signed_area(ring);
      covered(patch.box) += patch.mask / 255;
      EXPECT_EQ(patch.mask.size(), patch.box.size());
      for (const Point p : ring) {
        EXPECT_GE(p.x, patch.box.x);
        EXPECT_LE(p.x, patch.box.br().x);
        EXPECT_GE(p.y, patch.box.y);
        EXPECT_LE(p.y, patch.box.br().y);
      }
      const double width = params.min_width_mm / kMm, pixel = fair_precision(patch.outline, 0.01 * width);
      EXPECT_GE(2 * largest_inscribed(patch.outline, 0.001 * width).radius, 0.998 * width);
      EXPECT_GE(narrowest_neck(patch.outline, width, pixel).width, width - pixel);
      EXPECT_LE(largest_thin_part(patch.outline, width - 2 * pixel, pixel).area, 0.33 * width * width);
    }
    EXPECT_NEAR(sum, size.area(), 1e-6 * sum);
    EXPECT_EQ(cv::countNonZero(covered == 1), size.area());
  }
}

TEST(MorphedPatches, AreTheRegularGridWhereThePictureHasNoEdges) {
  const cv::Size size(5 * kCell, 4 * kCell);
  Rng rng(2, RngPurpose::kShapes);
  const Params params = morphed();
  const std::vector<Patch> regular = grid_patches(size, params, kMm);
  const cv::Mat1b nowhere(3, 3, static_cast<std::uint8_t>(0));
  const cv::Mat3b drawn = shapes(rng, size, 6);
  for (const auto& patches : {morphed_patches(cv::Mat3b(size, cv::Vec3b(90, 120, 70)), params, kMm),
                              morphed_patches(drawn, params, kMm, {nowhere, nowhere})}) {
    ASSERT_TRUE(patches);
    ASSERT_EQ(patches->size(), regular.size());
    for (std::size_t i = 0; i < regular.size(); ++i) {
      EXPECT_EQ((*patches)[i].box, regular[i].box);
      EXPECT_NEAR(area((*patches)[i].outline), area(regular[i].outline), 1e-6);
    }
  }
  // Each mask takes its edges away, Eq. 5.
  const Grid grid = grid_of(size, params, kMm);
  const cv::Mat1b all = EdgePicture(drawn, grid, 20).edges();
  const cv::Mat1b large = EdgePicture(drawn, grid, 20, {{}, nowhere}).edges();
  const cv::Mat1b fine = EdgePicture(drawn, grid, 20, {nowhere, {}}).edges();
  EXPECT_EQ(cv::countNonZero(all != (large | fine)), 0);
  EXPECT_GT(cv::countNonZero(large), 100);
  EXPECT_GT(cv::countNonZero(fine), 100);
}

TEST(EdgePicture, PotentialIsThatOfEquation6) {
  cv::Mat3b target(4 * kCell, 4 * kCell, cv::Vec3b(220, 220, 220));
  target.colRange(2 * kCell, 4 * kCell).setTo(cv::Vec3b(30, 30, 30));
  const EdgePicture edges(target, grid_of(target.size(), morphed(), kMm), 0.5 * kCell);
  const double half_way = 0.5 * kCell / edges.px();
  for (int x = 0; x < edges.edges().cols; ++x) {
    const double distance = edges.distance({(x + 0.5) * edges.px(), 2 * kCell}) / edges.px();
    EXPECT_NEAR(edges.potential()(40, x), std::max(0.0, std::min(distance, 2 * half_way - distance)), 1e-4);
  }
  EXPECT_NEAR(edges.distance({2 * kCell, 2 * kCell}), 0, edges.px());
  EXPECT_GT(edges.downhill({1.7 * kCell, 2 * kCell}).x, 0.9);
  EXPECT_LT(edges.downhill({1.3 * kCell, 2 * kCell}).x, -0.9);  // held off
}

TEST(MorphingGrid, SnapsToAnUprightEdge) {
  cv::Mat3b target(6 * kCell, 6 * kCell, cv::Vec3b(220, 220, 220));
  const double edge = 3.3 * kCell;
  target.colRange(static_cast<int>(edge), target.cols).setTo(cv::Vec3b(30, 30, 30));
  const Params params = morphed();
  const EdgePicture edges = edge_picture_of(target, params, kMm);
  auto grid = morphing_grid_of(target.size(), edges, params, kMm);
  ASSERT_TRUE(grid);
  grid->settle();
  const MorphedCells cells = cells_of(*grid, edges, params, kMm);
  for (int row = 0; row <= 6; ++row) {
    EXPECT_NEAR(grid->vertex(3, row).x, edge, edges.px());
    if (row < 6) {
      EXPECT_FALSE(cells.network.column(3, row).cut.empty());
      for (const Point p : cells.network.column(3, row).flat) EXPECT_NEAR(p.x, edge, edges.px());
    }
  }
  for (const Diagonal& diagonal : cells.diagonals) EXPECT_EQ(diagonal.way, Diagonal::Way::kNone);
}

TEST(MorphedPatches, AreSplitWhereAnEdgeRunsAlongDiagonals) {
  for (const bool falling : {true, false}) {
    cv::Mat3b target(6 * kCell, 6 * kCell, cv::Vec3b(220, 220, 220));
    const int last = target.cols - 1;
    for (int y = 0; y < target.rows; ++y)
      for (int x = 0; x < target.cols; ++x)
        if (y > (falling ? x : last - x) + 3) target(y, x) = cv::Vec3b(30, 30, 30);
    const std::vector<Patch> patches = patches_for(target, morphed());
    const std::vector<std::string> names = names_of(patches);
    int dark = 0, light = 0;
    for (std::size_t i = 0; i < patches.size(); ++i) {
      const int column = falling ? patches[i].column : 5 - patches[i].column;
      if (column != patches[i].row) continue;
      EXPECT_EQ(names[i].back(), patches[i].part == 0 ? 'a' : 'b');
      cv::Scalar mean, deviation;
      cv::meanStdDev(target(patches[i].box), mean, deviation, patches[i].mask);
      (patches[i].part == 0 ? light : dark) += deviation[0] < 45 && (mean[0] > 125) == (patches[i].part == 0);
    }
    EXPECT_GE(light, 5) << falling;
    EXPECT_GE(dark, 5) << falling;
  }
}

TEST(MorphedPatches, AreToldApartInAStateThatWasPutAside) {
  const Params params = morphed();
  cv::Mat3b target(4 * kCell, 4 * kCell, cv::Vec3b(220, 220, 220));
  for (int y = 0; y < target.rows; ++y) target.row(y).colRange(0, y).setTo(cv::Vec3b(30, 30, 30));
  const std::vector<Patch> patches = patches_for(target, params);
  EXPECT_GT(patches.size(), 16);
  std::vector<Laid> laid;
  for (std::size_t i = patches.size(); i-- > 0;) {
    laid.push_back({patches[i], {}});
    laid.back().placement.panel = static_cast<int>(i);
  }
  const auto read = read_state(write_state(7, laid), 7, patches, params, kMm);
  ASSERT_TRUE(read);
  ASSERT_EQ(read->size(), laid.size());
  for (std::size_t i = 0; i < laid.size(); ++i) {
    EXPECT_EQ((*read)[i].patch.outline.outer, laid[i].patch.outline.outer);
    EXPECT_EQ((*read)[i].placement.panel, laid[i].placement.panel);
  }
}

TEST(MorphedCells, FollowWithinTheErrorAndGoOnSmoothly) {
  Rng rng(5, RngPurpose::kShapes);
  int fitted = 0;
  for (int seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    const Params params = morphed();
    const cv::Mat3b target = shapes(rng, {7 * kCell, 6 * kCell}, 5);
    const EdgePicture edges = edge_picture_of(target, params, kMm);
    auto grid = morphing_grid_of(target.size(), edges, params, kMm);
    grid->settle();
    const MorphedCells cells = cells_of(*grid, edges, params, kMm);
    const double error = params.seam_error_mm / kMm;
    const auto look = [&](const SeamEdge& edge) {
      fitted += !edge.cut.empty();
      for (const Point p : edge.cut) {
        double nearest = 1e9;
        for (std::size_t i = 0; i + 1 < edge.flat.size(); ++i) {
          const Point way = edge.flat[i + 1] - edge.flat[i];
          const double share = std::clamp(dot(p - edge.flat[i], way) / dot(way, way), 0.0, 1.0);
          nearest = std::min(nearest, length(p - edge.flat[i] - share * way));
        }
        EXPECT_LE(nearest, 1.05 * error);
        EXPECT_LE(edges.distance(p), 8 * edges.px());
      }
    };
    for (const SeamEdge& edge : cells.network.columns) look(edge);
    for (const SeamEdge& edge : cells.network.rows) look(edge);
    for (const Diagonal& diagonal : cells.diagonals) look(diagonal.edge);
    // Two edges in one line that no edge of the picture fixes meet with one direction and one curvature.
    const auto curvature = [](const Bezier& c) {
      return 2.0 / 3 * cross(c[1] - c[0], c[2] - c[1]) / std::pow(length(c[1] - c[0]), 3);
    };
    const auto is_smooth = [](const SeamEdge& edge) { return edge.cut.empty() && edge.flat.size() > 2; };
    for (int line = 1; line < cells.network.across; ++line)
      for (int row = 1; row < cells.network.down; ++row) {
        const SeamEdge &above = cells.network.column(line, row - 1), &below = cells.network.column(line, row);
        if (!is_smooth(above) || !is_smooth(below)) continue;
        const Bezier &in = above.curves.back(), &out = below.curves.front();
        EXPECT_NEAR(cross(in[3] - in[2], out[1] - out[0]), 0, 1e-6 * length(in[3] - in[2]) * length(out[1] - out[0]));
        EXPECT_NEAR(curvature({in[3], in[2], in[1], in[0]}), -curvature(out), 1e-9);
      }
  }
  EXPECT_GT(fitted, 100);
}

TEST(MorphedPatches, AreTheSameForAnyNumberOfThreads) {
  Rng rng(6, RngPurpose::kShapes);
  const cv::Mat3b target = shapes(rng, {6 * kCell, 5 * kCell}, 6);
  cv::setNumThreads(1);
  const std::vector<Patch> one = patches_for(target, morphed());
  cv::setNumThreads(4);
  const std::vector<Patch> four = patches_for(target, morphed());
  cv::setNumThreads(-1);
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].outline.outer, four[i].outline.outer);
}

TEST(MorphingGrid, NeverFoldsACell) {
  Rng rng(7, RngPurpose::kShapes);
  for (int seed = 0; seed < 10; ++seed) {
    const cv::Mat3b target = shapes(rng, {6 * kCell, 6 * kCell}, 12);
    const Grid regular = grid_of(target.size(), morphed(), kMm);
    const EdgePicture edges(target, regular, kCell);
    MorphingGrid grid(regular, edges, 20, 0.8 * kCell);
    grid.pin({1 + seed % 5, 1 + seed % 4, {rng.uniform(0, 6 * kCell), rng.uniform(0, 6 * kCell)}});
    grid.pin({0, 2, {0, rng.uniform(0, 6 * kCell)}});
    for (int step = 0; step < 150; ++step) {
      grid.step();
      for (int row = 0; row < 6; ++row)
        for (int column = 0; column < 6; ++column) {
          const Ring cell = {grid.vertex(column, row), grid.vertex(column + 1, row), grid.vertex(column + 1, row + 1),
                             grid.vertex(column, row + 1)};
          ASSERT_GT(signed_area(cell), 0);
          ASSERT_TRUE(is_convex(cell));
          ASSERT_GE(2 * largest_inscribed({cell, {}}, 0.01).radius, 0.8 * kCell - 0.02);
        }
    }
    for (int k = 0; k <= 6; ++k) {
      EXPECT_EQ(grid.vertex(k, 0).y, 0);
      EXPECT_EQ(grid.vertex(k, 6).y, 6 * kCell);
      EXPECT_EQ(grid.vertex(0, k).x, 0);
      EXPECT_EQ(grid.vertex(6, k).x, 6 * kCell);
    }
  }
}

TEST(Pins, AreKept) {
  Rng rng(8, RngPurpose::kShapes);
  Params params = morphed();
  params.pins = "2,3:27.5,39.25; 0,1:0,14\n4,4:50,50";
  const cv::Mat3b target = shapes(rng, {6 * kCell, 6 * kCell}, 6);
  const EdgePicture edges = edge_picture_of(target, params, kMm);
  auto grid = morphing_grid_of(target.size(), edges, params, kMm);
  ASSERT_TRUE(grid);
  grid->settle();
  EXPECT_EQ(grid->vertex(2, 3), (Point{110, 157}));
  EXPECT_EQ(grid->vertex(0, 1), (Point{0, 56}));
  EXPECT_EQ(grid->vertex(4, 4), (Point{200, 200}));
  EXPECT_TRUE(morphed_patches(target, params, kMm));
  grid->unpin(4, 4);
  EXPECT_EQ(grid->pins().size(), 2);
}

TEST(Pins, ThatCannotBeKeptAreRefused) {
  const cv::Mat3b target(6 * kCell, 6 * kCell, cv::Vec3b(90, 90, 90));
  const auto message = [&](const char* pins) {
    Params params = morphed();
    params.pins = pins;
    const auto patches = morphed_patches(target, params, kMm);
    EXPECT_FALSE(patches) << pins;
    if (patches) return std::string();
    EXPECT_EQ(patches.error().field, "pins");
    return patches.error().message;
  };
  EXPECT_THAT(message("7,1:20,20; 1,9:3,3"), testing::AllOf(HasSubstr("7,1"), HasSubstr("1,9"), HasSubstr("6,6")));
  EXPECT_THAT(message("0,1:3,12"), HasSubstr("off the border"));
  EXPECT_THAT(message("0,0:0,3"), HasSubstr("off the border"));
  EXPECT_THAT(message("1,1:60,60; 5,5:12,12"), testing::AllOf(HasSubstr("1,1"), HasSubstr("too narrow")));
}

TEST(Pins, AreReadStrictly) {
  const auto problems = [](const char* text) {
    int count = 0;
    read_pins(text, [&](const std::string&) { ++count; });
    return count;
  };
  EXPECT_EQ(problems(""), 0);
  EXPECT_EQ(problems("3,4:123.5,87.2; 5,4:150,88"), 0);
  for (const char* text : {"3,4", "3:4,5,6", "3,4:5", "3,4:5,6,7", "-1,4:5,6", "1.5,4:5,6", "a,4:5,6", "3,4:nan,6",
                           "3,4:1e9,6", "3,4:5,6; 3,4:7,8", "1e300,4:5,6"})
    EXPECT_EQ(problems(text), 1) << text;
}

}  // namespace
}  // namespace tessera::parquetry
