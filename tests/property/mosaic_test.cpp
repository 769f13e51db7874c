// What must hold of every mosaic, whatever the photo, the seed and the parameters.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <opencv2/core/utility.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "../unit/mosaic/photos.h"
#include "tessera/geometry/scan.h"
#include "tessera/mosaic/run.h"
#include "tessera/voronoi/cpu_rasterizer.h"

namespace tessera::mosaic {
namespace {

Output lay(const cv::Mat3b& picture, const Params& params, std::uint64_t seed = 1) {
  const auto rasterizer = make_cpu_rasterizer();
  return run({view_of(picture), {}, {}, {}}, params, seed, *rasterizer, {}).value();
}

struct Laid {
  const Photo* photo;
  Params params;
  Output output;
  std::string name;
};

const std::vector<Laid>& all_results() {
  static const std::vector<Photo> photos = all_photos();
  static const std::vector<Laid> results = [] {
    std::vector<Laid> list;
    for (const Photo& photo : photos) {
      int variant = 0;
      for (const Shape shape : {Shape::kQuad, Shape::kSquare, Shape::kRectangle, Shape::kEllipse, Shape::kCell,
                                Shape::kMoment, Shape::kTrapezoid}) {
        for (const Style style : {Style::kVermiculatum, Style::kHausner}) {
          Params params;
          params.shape = shape;
          params.style = style;
          params.tiles = variant % 3 == 0 ? 40 : variant % 3 == 1 ? 200 : 1;
          params.grout = variant % 2;
          params.aspect = variant % 4 == 3 ? 2 : 1;
          params.iterations = variant % 5;
          params.settle = variant % 3;
          list.push_back({&photo, params, lay(photo.picture, params, variant),
                          photo.name + ", variant " + std::to_string(variant)});
          ++variant;
        }
      }
    }
    return list;
  }();
  return results;
}

TEST(MosaicProperty, EveryPhotoGetsTilesAndEveryNumberIsOne) {
  for (const Laid& laid : all_results()) {
    const auto& pieces = laid.output.sheet.pieces;
    EXPECT_FALSE(pieces.empty()) << laid.name;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      EXPECT_EQ(pieces[i].id, static_cast<int>(i) + 1) << laid.name;
      ASSERT_GE(pieces[i].outline.outer.size(), 3u) << laid.name;
      for (const Point p : pieces[i].outline.outer)
        ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y)) << laid.name;
      EXPECT_GT(laid.output.areas[i], 0) << laid.name;
    }
    for (const double v : {laid.output.field_angle, laid.output.edge_angle}) {
      EXPECT_TRUE(v >= 0 && v <= 45) << laid.name;
    }
    EXPECT_LE(laid.output.crossed, laid.output.at_edges) << laid.name;
  }
}

TEST(MosaicProperty, QuadsHaveSimpleOutlinesOfFourCornersAtLeast) {
  for (const Laid& laid : all_results()) {
    if (laid.params.shape != Shape::kQuad) continue;
    for (const Piece& tile : laid.output.sheet.pieces) {
      EXPECT_GE(tile.outline.outer.size(), 4u) << laid.name;
      EXPECT_TRUE(is_simple(tile.outline.outer)) << laid.name << ", tile " << tile.id;
      EXPECT_GT(signed_area(tile.outline.outer), 0) << laid.name << ", tile " << tile.id;
    }
  }
}

TEST(MosaicProperty, TilesStayInThePictureUnlessTheyAreStrokes) {
  constexpr double kSlack = 1e-6;
  for (const Laid& laid : all_results()) {
    if (laid.params.shape == Shape::kEllipse) continue;
    for (const Piece& tile : laid.output.sheet.pieces)
      for (const Point p : tile.outline.outer)
        ASSERT_TRUE(p.x >= -kSlack && p.y >= -kSlack && p.x <= laid.photo->picture.cols + kSlack &&
                    p.y <= laid.photo->picture.rows + kSlack)
            << laid.name << ", tile " << tile.id;
  }
}

// Pixels of a fine grid that more than one tile covers, and that any does, of all.
std::pair<double, double> overlap_and_coverage(const Laid& laid) {
  constexpr int kFine = 8;
  cv::Mat1b hits = cv::Mat1b::zeros(laid.photo->picture.rows * kFine, laid.photo->picture.cols * kFine);
  for (const Piece& tile : laid.output.sheet.pieces) {
    Ring ring = tile.outline.outer;
    for (Point& p : ring) p = kFine * p;
    each_run(ring, hits.cols, hits.rows, [&](int y, int begin, int end) {
      for (int x = begin; x < end; ++x) hits(y, x) = static_cast<unsigned char>(std::min(255, hits(y, x) + 1));
    });
  }
  const double all = static_cast<double>(hits.total());
  return {cv::countNonZero(hits > 1) / all, cv::countNonZero(hits) / all};
}

// What a seamless mosaic's tiles leave of the window when they are repeated around it: shares of a fine grid's points
// that several tiles cover, and that any does.
std::pair<double, double> repeated_overlap_and_coverage(const Output& output) {
  constexpr int kFine = 8;
  const int width = static_cast<int>(output.sheet.width), height = static_cast<int>(output.sheet.height);
  cv::Mat1b hits = cv::Mat1b::zeros(height * kFine, width * kFine);
  for (const Piece& tile : output.sheet.pieces)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        Ring ring = tile.outline.outer;
        for (Point& p : ring) p = kFine * (p + Point{1.0 * i * width, 1.0 * j * height});
        each_run(ring, hits.cols, hits.rows, [&](int y, int begin, int end) {
          for (int x = begin; x < end; ++x) hits(y, x) = static_cast<unsigned char>(std::min(255, hits(y, x) + 1));
        });
      }
  const double all = static_cast<double>(hits.total());
  return {cv::countNonZero(hits > 1) / all, cv::countNonZero(hits) / all};
}

TEST(MosaicProperty, ClippedTilesDoNotOverlap) {
  for (const Laid& laid : all_results()) {
    if (laid.params.shape == Shape::kEllipse) continue;
    const auto [overlap, coverage] = overlap_and_coverage(laid);
    EXPECT_LE(overlap, 0.004) << laid.name;  // a share of the fine grid's points lies on borders
    if (laid.params.shape == Shape::kCell && laid.params.grout == 0) {
      EXPECT_GE(coverage, 0.99) << laid.name;
    }
  }
}

TEST(MosaicProperty, QuadsWithoutGroutLeaveNoGaps) {
  Params params;
  params.tiles = 150;
  params.grout = 0;
  for (const Photo& photo : all_photos()) {
    Laid laid{&photo, params, lay(photo.picture, params), photo.name};
    EXPECT_GE(overlap_and_coverage(laid).second, 0.95) << photo.name;
  }
}

TEST(MosaicProperty, MomentTilesCoverMoreThanSquares) {
  const Photo photo{"disc", disc_photo(240)};
  const auto share = [&](Shape shape, double aspect) {
    Params params;
    params.shape = shape;
    params.tiles = 300;
    params.grout = 0;
    params.delta = 1;
    params.aspect = aspect;
    return overlap_and_coverage({&photo, params, lay(photo.picture, params), photo.name}).second;
  };
  for (const double aspect : {1.0, 2.5}) {
    EXPECT_GT(share(Shape::kMoment, aspect), 0.9);
    EXPECT_GT(share(Shape::kMoment, aspect), share(Shape::kRectangle, aspect) + 0.01);
  }
}

TEST(MosaicProperty, TrapezoidsCoverMoreThanSquaresRoundACurve) {
  const Photo photo{"disc", disc_photo(240)};
  const auto share = [&](Shape shape) {
    Params params;
    params.shape = shape;
    params.tiles = 120;
    params.variation = 1;
    params.grout = 0;
    params.delta = 1;
    return overlap_and_coverage({&photo, params, lay(photo.picture, params), photo.name}).second;
  };
  EXPECT_GT(share(Shape::kTrapezoid), share(Shape::kSquare) + 0.002);
}

TEST(MosaicProperty, ChipsFillWhatTilesLeaveOfTheirCells) {
  for (const Photo& photo : {Photo{"disc", disc_photo()}, Photo{"plain", plain_photo()}})
    for (const bool seamless : {false, true}) {
      Params params;
      params.shape = Shape::kSquare;
      params.tiles = 120;
      params.grout = 0;
      params.delta = 0.7;
      params.seamless = seamless;
      const auto laid = [&] { return Laid{&photo, params, lay(photo.picture, params), photo.name}; };
      const auto shares = [&](const Laid& l) {
        return seamless ? repeated_overlap_and_coverage(l.output) : overlap_and_coverage(l);
      };
      const Laid bare = laid();
      params.chips = true;
      const Laid full = laid();
      EXPECT_LT(shares(bare).second, 0.55) << photo.name;
      EXPECT_GT(shares(full).second, 0.93) << photo.name;
      EXPECT_LE(shares(full).first, 0.006) << photo.name;
      // Tiles stay as they are; chips follow.
      ASSERT_GT(full.output.sheet.pieces.size(), 2 * bare.output.sheet.pieces.size());
      for (std::size_t i = 0; i < bare.output.sheet.pieces.size(); ++i)
        EXPECT_EQ(full.output.sheet.pieces[i].outline.outer, bare.output.sheet.pieces[i].outline.outer);
    }
}

TEST(MosaicProperty, AboutAsManyTilesAsAskedFor) {
  for (const int tiles : {50, 200, 800}) {
    Params params;
    params.tiles = tiles;
    const auto count = lay(disc_photo(), params).sheet.pieces.size();
    EXPECT_NEAR(static_cast<double>(count), tiles, 0.15 * tiles);
    params.style = Style::kHausner;
    EXPECT_NEAR(static_cast<double>(lay(disc_photo(), params).sheet.pieces.size()), tiles, 0.02 * tiles);
  }
}

TEST(MosaicProperty, NoMoreTilesThanThereIsRoomFor) {
  Params params;
  params.tiles = 4194304;
  for (const Style style : {Style::kVermiculatum, Style::kHausner}) {
    params.style = style;
    const auto count = lay(plain_photo(), params).sheet.pieces.size();
    EXPECT_GT(count, 400u);
    EXPECT_LT(count, 120u * 90u / 4);
  }
}

TEST(MosaicProperty, SameTilesForAnyNumberOfThreads) {
  const int before = cv::getNumThreads();
  std::vector<std::vector<Ring>> rings;
  for (const int threads : {1, 2, 5}) {
    cv::setNumThreads(threads);
    rings.emplace_back();
    for (const Piece& tile : lay(disc_photo(), {}).sheet.pieces) rings.back().push_back(tile.outline.outer);
  }
  cv::setNumThreads(before);
  EXPECT_EQ(rings[0], rings[1]);
  EXPECT_EQ(rings[0], rings[2]);
}

TEST(MosaicProperty, TilesFollowTheDiscsEdge) {
  Params params;
  params.tiles = 400;
  params.variation = 1;
  const Output output = lay(disc_photo(240), params);
  EXPECT_LT(output.field_angle, 6);
  EXPECT_LT(output.edge_angle, 6);
  EXPECT_LT(output.crossed, 0.1 * output.at_edges);
  EXPECT_GT(output.at_edges, 20);
}

TEST(MosaicProperty, WithoutEdgesTilesAreAGridAlongThePicturesSides) {
  Params params;
  params.tiles = 108;
  const Output output = lay(plain_photo(), params);
  EXPECT_EQ(output.at_edges, 0);
  EXPECT_LT(output.field_angle, 1);
}

// How often the seam, a line along the window's left side and one along its top, runs through a tile.
int tiles_across_the_seam(const Output& output) {
  int across = 0;
  for (const Piece& tile : output.sheet.pieces) {
    const Ring& ring = tile.outline.outer;
    const auto sticks_out = [&](Point p) {
      return p.x < -0.5 || p.y < -0.5 || p.x > output.sheet.width + 0.5 || p.y > output.sheet.height + 0.5;
    };
    across += std::any_of(ring.begin(), ring.end(), sticks_out);
  }
  return across;
}

TEST(MosaicProperty, SeamlessTilesMeetTheirOwnCopies) {
  for (const Photo& photo :
       {Photo{"disc", disc_photo()}, Photo{"plain", plain_photo()}, Photo{"noise", noise_photo()}})
    for (const Shape shape : {Shape::kQuad, Shape::kSquare, Shape::kCell})
      for (const Style style : {Style::kVermiculatum, Style::kHausner}) {
        Params params;
        params.seamless = true;
        params.shape = shape;
        params.style = style;
        params.tiles = 150;
        params.grout = 0;
        params.iterations = 6;
        const Output output = lay(photo.picture, params);
        const auto [overlap, coverage] = repeated_overlap_and_coverage(output);
        const std::string name = photo.name + " " + std::to_string(static_cast<int>(shape));
        EXPECT_LE(overlap, 0.004) << name;
        if (shape != Shape::kSquare) {
          EXPECT_GE(coverage, shape == Shape::kCell ? 0.995 : 0.97) << name;
        }
        if (photo.name != "plain") {  // whose rows may lie along the seam
          EXPECT_GT(tiles_across_the_seam(output), 4) << name;
        }
        EXPECT_NEAR(static_cast<double>(output.sheet.pieces.size()), 150, 30) << name;
      }
}

// Black at the left and the top, white at the right and the bottom.
TEST(MosaicProperty, SeamlessMosaicsHaveTheSameColoursAtOppositeSides) {
  const cv::Mat3b slope = paint(200, 160, [](double x, double y) {
    const auto v = static_cast<unsigned char>(255 * (x / 200 + y / 160) / 2);
    return cv::Vec3b(v, v, v);
  });
  Params params;
  params.tiles = 400;
  params.variation = 1;
  const auto difference = [&](bool seamless) {
    params.seamless = seamless;
    double left = 0, right = 0;
    int at_left = 0, at_right = 0;
    for (const Piece& tile : lay(slope, params).sheet.pieces) {
      const Point centre = centroid(tile.outline.outer);
      if (centre.x < 6) left += tile.fill.r, ++at_left;
      if (centre.x > 194) right += tile.fill.r, ++at_right;
    }
    return right / at_right - left / at_left;
  };
  EXPECT_GT(difference(false), 100);
  EXPECT_LT(difference(true), 40);
}

TEST(MosaicProperty, SeamlessSquaresAreMovedApartAcrossTheSeam) {
  Params params;
  params.seamless = true;
  params.shape = Shape::kSquare;
  params.clip = false;
  params.tiles = 150;
  params.delta = 0.9;
  EXPECT_LE(repeated_overlap_and_coverage(lay(disc_photo(), params)).first, 0.01);
}

TEST(MosaicProperty, SeamlessMosaicsAreMadeOfAnyPhoto) {
  for (const Photo& photo : all_photos())
    for (const int tiles : {1, 30}) {
      Params params;
      params.seamless = true;
      params.tiles = tiles;
      params.iterations = 3;
      const Output output = lay(photo.picture, params);
      EXPECT_FALSE(output.sheet.pieces.empty()) << photo.name << " " << tiles;
      for (const Piece& tile : output.sheet.pieces)
        for (const Point p : tile.outline.outer) ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y)) << photo.name;
    }
}

TEST(MosaicProperty, IterationsOfASeamlessMosaicShowThePhotosWindow) {
  const cv::Mat3b picture = disc_photo();
  const auto rasterizer = make_cpu_rasterizer();
  Params params;
  params.seamless = true;
  params.tiles = 100;
  params.iterations = 2;
  int seen = 0;
  const auto observer = [&](const Iteration& iteration) {
    ++seen;
    ASSERT_EQ(iteration.labels.size(), picture.size());
    double least, most;
    cv::minMaxLoc(iteration.labels, &least, &most);
    EXPECT_GE(least, 0);
    EXPECT_LT(most, static_cast<double>(iteration.sites.size()));
    for (const Site& site : iteration.sites) EXPECT_TRUE(site.x >= 0 && site.x < 160 && site.y >= 0 && site.y < 160);
  };
  ASSERT_TRUE(run({view_of(picture), {}, {}, {}}, params, 1, *rasterizer, {}, observer));
  EXPECT_EQ(seen, 3);
}

TEST(MosaicProperty, EndsWhenItIsStopped) {
  const cv::Mat3b picture = disc_photo();
  const auto rasterizer = make_cpu_rasterizer();
  std::atomic<int> stop = static_cast<int>(StopReason::kNone);
  RunContext context;
  context.stop = &stop;
  const auto observer = [&](const Iteration& iteration) {
    if (iteration.index == 2) stop = static_cast<int>(StopReason::kCancelled);
  };
  const auto result = run({view_of(picture), {}, {}, {}}, {}, 1, *rasterizer, context, observer);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, StatusCode::kCancelled);
}

}  // namespace
}  // namespace tessera::mosaic
