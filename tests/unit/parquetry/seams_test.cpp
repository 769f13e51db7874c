#include "tessera/parquetry/seams.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>

#include "../distances.h"
#include "boards.h"
#include "tessera/geometry/scan.h"
#include "tessera/parquetry/run.h"
#include "tessera/parquetry/seam_curves.h"
#include "tessera/parquetry/shape.h"
#include "tessera/parquetry/spare_wood.h"
#include "tessera/parquetry/widen.h"

namespace tessera::parquetry {
namespace {

// All 6-connected cuts of `costs`, one after the other.
void each_cut(const CutCosts& costs, const std::function<void(const std::vector<int>&)>& visit) {
  const int rows = static_cast<int>(costs.costs.size()) / costs.width;
  std::vector<int> cut;
  const std::function<void()> go_on = [&] {
    if (static_cast<int>(cut.size()) == rows) return visit(cut);
    for (int place = 0; place < costs.width; ++place) {
      if (!cut.empty()) {
        const int step = place - cut.back();
        const auto barred = costs.barred[(cut.size() - 1) * costs.width + cut.back()];
        if (std::abs(step) > 1 || (step < 0 && (barred & CutCosts::kLeft)) ||
            (step > 0 && (barred & CutCosts::kRight)))
          continue;
      }
      cut.push_back(place);
      go_on();
      cut.pop_back();
    }
  };
  go_on();
}

TEST(CheapestCut, IsTheBestOfAll) {
  Rng rng(1, RngPurpose::kShapes);
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const int overlap = 1 + seed % 4, rows = 2 + seed % 6;
    std::vector<std::int64_t> left(rows * overlap), right(rows * overlap);
    for (auto* errors : {&left, &right})
      for (std::int64_t& e : *errors) e = static_cast<std::int64_t>(rng.uniform(0, seed % 3 == 0 ? 4 : 100));
    CutCosts costs{overlap + 1, std::vector<std::int64_t>(rows * (overlap + 1)), {}};
    for (int y = 0; y < rows; ++y)
      cut_costs(&left[y * overlap], &right[y * overlap], overlap, &costs.costs[y * costs.width]);
    costs.barred.resize(costs.costs.size());
    for (auto& steps : costs.barred)
      steps = seed % 2 == 0 || rng.uniform() < 0.7 ? 0 : 1 + static_cast<int>(rng.uniform(0, 3));
    // Eq. 9, as it is written.
    const auto price = [&](const std::vector<int>& cut) {
      std::int64_t sum = 0;
      for (int y = 0; y < rows; ++y)
        for (int x = 0; x < overlap; ++x) sum += (x < cut[y] ? left : right)[y * overlap + x];
      return sum;
    };
    std::int64_t least = CutCosts::kNever;
    bool found = false;
    const std::vector<int> cheapest = cheapest_cut(costs);
    each_cut(costs, [&](const std::vector<int>& cut) {
      least = std::min(least, price(cut));
      found |= cut == cheapest;
    });
    EXPECT_TRUE(found);
    EXPECT_EQ(price(cheapest), least);
  }
}

// Pieces whose features have nothing to do with each other, some without wood.
Reconstruction made_up(Rng& rng, int across, int down, int side, int growth, double missing) {
  Reconstruction made;
  for (int k = 0; k <= across; ++k) made.grid.columns.push_back(k * side);
  for (int k = 0; k <= down; ++k) made.grid.rows.push_back(k * side);
  const cv::Size size(across * side, down * side);
  const auto fill = [&](cv::Size of) {
    const double period = rng.uniform(2, 12), way = rng.uniform(-2, 2), noise = rng.uniform(0, 120);
    cv::Mat features(of, CV_8UC2);
    for (int y = 0; y < of.height; ++y)
      for (int k = 0; k < 2 * of.width; ++k)
        features.ptr(y)[k] =
            cv::saturate_cast<std::uint8_t>(100 + 70 * std::sin((k + way * y) / period) + rng.uniform(0, noise));
    return features;
  };
  made.target = fill(size);
  for (int row = 0; row < down; ++row)
    for (int column = 0; column < across; ++column) {
      const cv::Rect box = made.grid.around(column, row, growth);
      made.pieces.push_back({box, rng.uniform() < missing ? cv::Mat() : fill(box.size()), {}});
    }
  return made;
}

void expect_connected_and_near(const Grid& grid, const Seams& seams, int stray) {
  const auto look = [&](const std::vector<Seam>& lines, const std::vector<int>& at) {
    EXPECT_EQ(lines.front(), Seam(lines.front().size(), 0));
    EXPECT_EQ(lines.back(), Seam(lines.back().size(), at.back()));
    for (std::size_t line = 0; line < lines.size(); ++line)
      for (std::size_t k = 0; k < lines[line].size(); ++k) {
        ASSERT_LE(std::abs(lines[line][k] - at[line]), stray);
        if (k > 0) {
          ASSERT_LE(std::abs(lines[line][k] - lines[line][k - 1]), 1);
        }
      }
  };
  look(seams.columns, grid.columns);
  look(seams.rows, grid.rows);
}

TEST(Seams, GainAndKeepTheirLimits) {
  Rng rng(2, RngPurpose::kShapes);
  for (int seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const int stray = 1 + seed % 7;
    const Reconstruction made = made_up(rng, 1 + seed % 5, 1 + seed % 3, 24, stray + 1, seed % 4 == 0 ? 0.3 : 0);
    const Seams seams = find_seams(made, {stray, 2.5, 2});
    expect_connected_and_near(made.grid, seams, stray);
    const std::int64_t straight = cost_of(made, straight_seams(made.grid)), cost = cost_of(made, seams);
    EXPECT_LE(cost, straight);
    if (made.pieces.size() > 3 && seed % 4 != 0) {
      EXPECT_LT(cost, straight);
    }
    // A piece without wood has its cell, no more and no less.
    for (int row = 0; row < made.grid.down(); ++row)
      for (int column = 0; column < made.grid.across(); ++column) {
        if (!made.piece(column, row).features.empty()) continue;
        const cv::Rect cell = made.grid.cell(column, row);
        for (int y = cell.y; y < cell.br().y; ++y) {
          EXPECT_EQ(seams.columns[column][y], cell.x);
          EXPECT_EQ(seams.columns[column + 1][y], cell.br().x);
        }
        for (int x = cell.x; x < cell.br().x; ++x) {
          EXPECT_EQ(seams.rows[row][x], cell.y);
          EXPECT_EQ(seams.rows[row + 1][x], cell.br().y);
        }
      }
  }
}

// Around their cells, pieces may have some blotches of pixels only.
void take_away(Rng& rng, Reconstruction& made) {
  for (int i = 0; i < static_cast<int>(made.pieces.size()); ++i) {
    Reconstruction::Piece& piece = made.pieces[i];
    piece.free = cv::Mat1b(piece.box.size(), 255);
    for (int k = 0; k < 12; ++k) {
      const cv::Rect blotch(static_cast<int>(rng.uniform(0, piece.box.width)),
                            static_cast<int>(rng.uniform(0, piece.box.height)), static_cast<int>(rng.uniform(1, 14)),
                            static_cast<int>(rng.uniform(1, 14)));
      piece.free(blotch & cv::Rect({0, 0}, piece.box.size())).setTo(0);
    }
    const cv::Rect cell = made.grid.cell(i % made.grid.across(), i / made.grid.across());
    piece.free(cell - piece.box.tl()).setTo(255);
  }
}

int pixels_not_free(const Reconstruction& made, const Seams& seams) {
  int count = 0;
  for (int y = 0; y < made.target.rows; ++y)
    for (int x = 0; x < made.target.cols; ++x)
      for (int row = 0; row < made.grid.down(); ++row)
        for (int column = 0; column < made.grid.across(); ++column)
          if (seams.columns[column][y] <= x && x < seams.columns[column + 1][y] && seams.rows[row][x] <= y &&
              y < seams.rows[row + 1][x])
            count += made.piece(column, row).may_have(x, y) ? 0 : 1;
  return count;
}

TEST(Seams, GivePiecesWhatTheyMayHave) {
  Rng rng(8, RngPurpose::kShapes);
  int gains = 0;
  for (int seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const int stray = 2 + seed % 7;
    Reconstruction made = made_up(rng, 2 + seed % 3, 1 + seed % 3, 30, stray + 1, 0);
    const Seams anywhere = find_seams(made, {stray, 2.5, 2});
    take_away(rng, made);
    Seams seams = find_seams(made, {stray, 2.5, 2});
    EXPECT_EQ(pixels_not_free(made, seams), 0);
    const std::int64_t straight = cost_of(made, straight_seams(made.grid)), cost = cost_of(made, seams);
    EXPECT_LE(cost, straight);
    gains += cost < straight ? 1 : 0;
    widen(made, stray, 16, seams);
    EXPECT_EQ(pixels_not_free(made, seams), 0);
    // Whatever they were before.
    seams = anywhere;
    widen(made, stray, 16, seams);
    EXPECT_EQ(pixels_not_free(made, seams), 0);
    expect_connected_and_near(made.grid, seams, stray);
  }
  EXPECT_EQ(gains, 40);
}

// A target that one of two neighbours shows up to a slanted line, the other beyond it: that is where the seam is.
TEST(Seams, FollowWhatThePiecesShow) {
  const int side = 40, stray = 6;
  Rng rng(3, RngPurpose::kShapes);
  Reconstruction made = made_up(rng, 2, 1, side, stray + 2, 0);
  const auto line = [&](int y) { return side - 4 + y / 5; };
  for (int k = 0; k < 2; ++k) {
    auto& piece = made.pieces[k];
    for (int y = 0; y < side; ++y)
      for (int x = piece.box.x; x < piece.box.br().x; ++x)
        for (int c = 0; c < 2; ++c)
          piece.features.ptr(y)[2 * (x - piece.box.x) + c] =
              made.target.ptr(y)[2 * x + c] ^ ((x < line(y)) == (k == 0) ? 0 : 64);
  }
  const Seams seams = find_seams(made, {stray, 0, 0});
  for (int y = 0; y < side; ++y) EXPECT_EQ(seams.columns[1][y], line(y)) << y;
  EXPECT_EQ(cost_of(made, seams), 0);
}

// Pieces are simple, together they are the target, and each pixel's middle is where the seams have it or near to
// them.
TEST(SeamNetwork, CoversTheTargetOnce) {
  Rng rng(4, RngPurpose::kShapes);
  for (int seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const int stray = 1 + seed % 8, across = 1 + seed % 4, down = 1 + seed % 3;
    const double error = seed % 2 == 0 ? 0.6 : 0.3;
    const Reconstruction made = made_up(rng, across, down, 40, stray + 2, 0.1);
    Seams seams = find_seams(made, {stray, 2.5, 2.5});
    widen(made, stray, 16, seams);
    expect_connected_and_near(made.grid, seams, stray);
    const SeamNetwork network = network_of(made.grid, seams, error, seed % 3 == 0 ? Joints::kG0 : Joints::kG1);
    double sum = 0;
    cv::Mat1b covered(made.target.size(), 0);
    for (int row = 0; row < down; ++row)
      for (int column = 0; column < across; ++column) {
        const Ring outline = network.outline(column, row);
        EXPECT_TRUE(is_simple(outline));
        EXPECT_GT(signed_area(outline), 0);
        sum += signed_area(outline);
        const cv::Rect box = made.piece(column, row).box;
        for (const Point p : outline) {
          EXPECT_GE(p.x, box.x);
          EXPECT_LE(p.x, box.br().x);
          EXPECT_GE(p.y, box.y);
          EXPECT_LE(p.y, box.br().y);
        }
        each_run(outline, covered.cols, covered.rows, [&](int y, int begin, int end) {
          for (int x = begin; x < end; ++x) {
            ++covered(y, x);
            const int off = std::max({seams.columns[column][y] - x, x + 1 - seams.columns[column + 1][y],
                                      seams.rows[row][x] - y, y + 1 - seams.rows[row + 1][x]});
            EXPECT_LE(off, 2);
          }
        });
      }
    EXPECT_NEAR(sum, made.target.size().area(), 1e-6 * sum);
    EXPECT_EQ(cv::countNonZero(covered == 1), covered.size().area());
  }
}

TEST(SeamNetwork, IsWithinTheErrorAndSmooth) {
  Rng rng(5, RngPurpose::kShapes);
  for (int seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const int stray = 2 + seed % 6, across = 3, down = 3;
    const double error = seed % 2 == 0 ? 0.6 : 0.25;
    const Reconstruction made = made_up(rng, across, down, 40, stray + 2, 0);
    const Seams seams = find_seams(made, {stray, 2.5, 2.5});
    const SeamNetwork network = network_of(made.grid, seams, error, Joints::kG1);
    const auto turn = [](const Bezier& a, const Bezier& b) {
      const Point in = a[3] - a[2], out = b[1] - b[0];
      return std::abs(std::atan2(cross(in, out), dot(in, out)));
    };
    const auto look = [&](const std::vector<SeamEdge>& edges) {
      for (const SeamEdge& edge : edges) {
        for (const Point p : edge.flat) EXPECT_LE(distance_to(p, edge.cut), 1.05 * error);
        for (const Point p : edge.cut) EXPECT_LE(distance_to(p, edge.flat), 1.05 * error);
        for (std::size_t k = 0; k + 1 < edge.curves.size(); ++k)
          EXPECT_LT(turn(edge.curves[k], edge.curves[k + 1]), 1e-6);
      }
    };
    look(network.columns);
    look(network.rows);
    // And where others cross.
    for (int line = 1; line < across; ++line)
      for (int row = 0; row + 1 < down; ++row)
        EXPECT_LT(turn(network.column(line, row).curves.back(), network.column(line, row + 1).curves.front()), 1e-6);
    for (int line = 1; line < down; ++line)
      for (int column = 0; column + 1 < across; ++column)
        EXPECT_LT(turn(network.row(line, column).curves.back(), network.row(line, column + 1).curves.front()), 1e-6);
  }
}

TEST(Widen, FindsNecksHornsAndThinPieces) {
  cv::Mat1b piece(60, 60, static_cast<std::uint8_t>(0));
  piece(cv::Rect(10, 10, 30, 30)).setTo(255);
  EXPECT_TRUE(narrow_places(piece, 16).empty());
  EXPECT_EQ(narrow_places(piece, 33), std::vector<cv::Rect>{cv::Rect(0, 0, 60, 60)});
  cv::Mat1b horn = piece.clone();
  horn(cv::Rect(40, 20, 14, 7)).setTo(255);
  const auto places = narrow_places(horn, 16);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_EQ(places[0] & cv::Rect(38, 18, 18, 11), places[0]);
  cv::Mat1b two(60, 100, static_cast<std::uint8_t>(0));
  two(cv::Rect(5, 10, 30, 30)).setTo(255);
  two(cv::Rect(50, 10, 30, 30)).setTo(255);
  two(cv::Rect(30, 20, 30, 9)).setTo(255);
  EXPECT_EQ(narrow_places(two, 16), std::vector<cv::Rect>{cv::Rect(0, 0, 100, 60)});
}

TEST(Widen, LeavesNothingNarrow) {
  Rng rng(6, RngPurpose::kShapes);
  double moved = 0;
  for (int seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const int stray = 8, side = 40;
    const double width = 20;
    const Reconstruction made = made_up(rng, 3, 3, side, stray + 1, 0);
    const Seams before = find_seams(made, {stray, 1.0 * stray, 0});
    Seams seams = before;
    widen(made, stray, width, seams);
    expect_connected_and_near(made.grid, seams, stray);
    moved += share_moved(before, seams);
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) {
        cv::Mat1b mask(3 * side + 2, 3 * side + 2, static_cast<std::uint8_t>(0));
        for (int y = 0; y < 3 * side; ++y)
          for (int x = seams.columns[column][y]; x < seams.columns[column + 1][y]; ++x)
            if (seams.rows[row][x] <= y && y < seams.rows[row + 1][x]) mask(y + 1, x + 1) = 255;
        EXPECT_TRUE(narrow_places(mask, width).empty());
      }
  }
  EXPECT_GT(moved, 0);
}

// Pieces laid side by side, some turned: two never get places that are too near to each other or to what is no wood.
TEST(SpareWood, IsNearestToItsPieceAndAwayFromOthers) {
  Rng rng(9, RngPurpose::kShapes);
  const double apart = 4, inside = 3;
  int given = 0;
  for (int seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<Panel> panels = {board(rng, {120, 90}, 4), board(rng, {120, 90}, 0)};
    std::vector<Patch> patches;
    std::vector<Placement> placements;
    std::vector<Ring> cuts;
    for (int i = 0; i < 60; ++i) {
      Patch patch;
      patch.box = {20, 20, 10 + i % 5, 12};
      const double right = patch.box.br().x, bottom = patch.box.br().y;
      patch.outline.outer = {{20, 20}, {right, 20}, {right, bottom}, {20, bottom}};
      Placement placement;
      placement.panel = i % 9 == 0 ? -1 : i % 2;
      placement.turn_deg = i % 3 == 0 ? 0 : rng.uniform(0, 360);
      placement.from = {20 + 0.5 * patch.box.width, 26};
      placement.to = {rng.uniform(10, 110), rng.uniform(10, 80)};
      const Ring cut = on_panel(placement, patch.outline).outer;
      bool fits = true;
      for (std::size_t k = 0; placement.panel >= 0 && k < cuts.size(); ++k)
        fits &= placements[k].panel != placement.panel || are_apart(cut, cuts[k], apart);
      if (!fits) continue;
      patches.push_back(patch);
      placements.push_back(placement);
      cuts.push_back(cut);
    }
    const SpareWood spare(panels, patches, placements, apart, inside);
    const cv::Rect box(14, 14, 30, 24);
    struct Place {
      std::size_t piece;
      Point at;
    };
    std::vector<Place> places;
    for (std::size_t i = 0; i < patches.size(); ++i) {
      const cv::Mat1b free = spare.around(i, box);
      EXPECT_EQ(cv::countNonZero(free(patches[i].box - box.tl())), patches[i].box.area());
      if (placements[i].panel < 0) {
        EXPECT_EQ(cv::countNonZero(free), patches[i].box.area());
        continue;
      }
      for (int y = 0; y < box.height; ++y)
        for (int x = 0; x < box.width; ++x) {
          if (free(y, x) == 0) continue;
          const Point p{box.x + x + 0.5, box.y + y + 0.5};
          places.push_back({i, on_panel(placements[i], {{p}, {}}).outer[0]});
          if (patches[i].box.contains({box.x + x, box.y + y})) continue;
          ++given;
          const cv::Mat1b& mask = panels[placements[i].panel].mask;
          for (int v = -1; v <= mask.rows; ++v)
            for (int u = -1; u <= mask.cols; ++u)
              if (u < 0 || v < 0 || u == mask.cols || v == mask.rows || mask(v, u) == 0) {
                ASSERT_GE(length(places.back().at - Point{u + 0.5, v + 0.5}), inside - 1e-3);
              }
        }
    }
    for (const Place& a : places)
      for (const Place& b : places)
        if (a.piece < b.piece && placements[a.piece].panel == placements[b.piece].panel) {
          ASSERT_GE(length(a.at - b.at), apart - 1e-9);
        }
  }
  EXPECT_GT(given, 1000);
}

struct Scene {
  std::vector<Panel> panels;
  Request request;
  Params params;
};

Scene scene(int seed, SeamKind seams, cv::Size wood = {150, 120}) {
  Scene made;
  Rng rng(seed, RngPurpose::kShapes);
  made.params.patch_mm = 14;
  made.params.min_width_mm = 4;
  made.params.rotations = 5;
  made.params.overlap_mm = 6;
  made.params.seams = seams;
  made.params.seam_error_mm = 0.5;
  made.panels = {board(rng, wood, 3)};
  made.request.targets = {blotches(rng, {56, 42})};
  made.request.patches = grid_patches({56, 42}, made.params, 1);
  return made;
}

TEST(SeamsOfARun, KeepThePiecesInTheWoodThatWasTaken) {
  for (int seed = 1; seed <= 9; ++seed) {
    SCOPED_TRACE(seed);
    const Scene made = scene(seed, seed % 2 == 0 ? SeamKind::kG0 : SeamKind::kG1,
                             seed % 3 == 0 ? cv::Size(80, 60) : cv::Size(150, 120));
    const Output output = run(made.panels, made.request, made.params, {}).value();
    EXPECT_LT(output.reconstruction_cost, output.straight_cost);
    EXPECT_EQ(output.straight_cost, output.cost);
    SlowWood wood(made.panels, made.params);
    double sum = 0;
    for (std::size_t i = 0; i < output.patches.size(); ++i) {
      sum += area(output.patches[i].outline);
      if (output.placements[i].panel < 0) continue;
      const Shape shape = shape_of(output.patches[i], 0.5 * made.params.kerf_mm);
      const Ring cut = on_panel(output.placements[i], shape.cut).outer;
      EXPECT_TRUE(wood.fits(output.placements[i].panel, cut)) << i;
      wood.cuts.emplace_back(output.placements[i].panel, cut);
    }
    EXPECT_NEAR(sum, 56 * 42, 1e-6);
    if (seed % 3 == 0) {
      EXPECT_GT(output.without_wood, 0);
    }
  }
}

TEST(SeamsOfARun, AreTheSameForAnyNumberOfThreads) {
  const Scene made = scene(7, SeamKind::kG1);
  cv::setNumThreads(1);
  const Output one = run(made.panels, made.request, made.params, {}).value();
  cv::setNumThreads(4);
  const Output four = run(made.panels, made.request, made.params, {}).value();
  cv::setNumThreads(-1);
  ASSERT_EQ(one.patches.size(), four.patches.size());
  for (std::size_t i = 0; i < one.patches.size(); ++i)
    EXPECT_EQ(one.patches[i].outline.outer, four.patches[i].outline.outer);
  EXPECT_EQ(one.reconstruction_cost, four.reconstruction_cost);
}

TEST(SeamsOfARun, WantTheGrid) {
  Scene made = scene(8, SeamKind::kG1);
  made.request.patches.pop_back();
  const auto output = run(made.panels, made.request, made.params, {});
  ASSERT_FALSE(output);
  EXPECT_EQ(output.error().field, "seams");
}

// Straight cuts, where patches leave no room for others.
TEST(SeamsOfARun, AreStraightWithoutRoom) {
  Scene made = scene(9, SeamKind::kG1);
  made.params.min_width_mm = 13.5;
  made.request.patches = grid_patches({56, 42}, made.params, 1);
  const Output output = run(made.panels, made.request, made.params, {}).value();
  for (const Patch& patch : output.patches) EXPECT_EQ(patch.outline.outer.size(), 4u);
  EXPECT_EQ(output.reconstruction_cost, output.cost);
}

}  // namespace
}  // namespace tessera::parquetry
