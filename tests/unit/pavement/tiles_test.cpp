// Tile by tile: the stones of run(), but for some at the tiles' borders, and those join without a seam.
#include "tessera/pavement/tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <string>
#include <vector>

#include "drawings.h"
#include "tessera/formats/text.h"
#include "tessera/pavement/run.h"
#include "tessera/voronoi/cpu_rasterizer.h"

namespace tessera::pavement {
namespace {

struct Case {
  std::string name;
  cv::Mat3b drawing;
  Params params;
  std::uint64_t seed = 1;
  double may_differ = 0;  // of the stones far from borders
};

Params params_with(double half_side, int tiles, int colors = 2) {
  Params params;
  params.half_side = half_side;
  params.tiles = tiles;
  params.colors = colors;
  return params;
}

// Waves and a lens, whose edges cross tile borders at all angles; lines of one pixel, which double the diagram's
// pixels; specks, some of which no site reaches; four colours; an empty sheet.
std::vector<Case> cases() {
  const cv::Mat3b waves = draw(700, 560, [](double x, double y) {
    return (std::fmod(y + 20 * std::sin(x / 31) + 100, 90) < 45) != (std::hypot(x - 400, y - 250) < 130);
  });
  cv::Mat3b lines = flat_drawing(420, 380, 255), specks = flat_drawing(560, 420, 255), colours(420, 560);
  for (int i = 15; i < 380; i += 29) {
    cv::line(lines, {0, i}, {419, 379 - i}, cv::Scalar::all(0));
    lines.row(i).setTo(cv::Scalar::all(0));
  }
  Rng rng(3, RngPurpose::kNoise);
  for (int i = 0; i < 4000; ++i)
    specks(static_cast<int>(rng.bits() % 420), static_cast<int>(rng.bits() % 560)) = grey(0);
  for (int y = 0; y < colours.rows; ++y)
    for (int x = 0; x < colours.cols; ++x) colours(y, x) = four_colour_drawing()((y / 7) % 60, (x / 7) % 80);
  return {{"waves", waves, params_with(1.5, 192)},
          {"waves, other tiles and seed", waves, params_with(2, 257), 7},
          {"lines", lines, params_with(1.5, 190)},
          {"specks", specks, params_with(1.5, 192), 1, 0.001},
          {"four colours", colours, params_with(1.5, 192, 4)},
          {"empty", flat_drawing(600, 430, 255), params_with(1.5, 192)}};
}

Output in_tiles(const cv::Mat3b& drawing, const Params& params, std::uint64_t seed) {
  RowsOfView rows(view_of(drawing));
  Output all;
  const auto rasterizer = make_cpu_rasterizer();
  const auto done = run_tiles(rows, params, seed, *rasterizer, {}, [&](Output part) -> Result<void> {
    EXPECT_EQ(part.first_id, static_cast<int>(all.sheet.pieces.size()) + 1);
    EXPECT_EQ(part.sheet.width, drawing.cols);
    for (Piece& piece : part.sheet.pieces) all.sheet.pieces.push_back(std::move(piece));
    return {};
  });
  EXPECT_TRUE(done);
  return all;
}

Output at_once(const cv::Mat3b& drawing, const Params& params, std::uint64_t seed) {
  const auto rasterizer = make_cpu_rasterizer();
  return run(view_of(drawing), params, seed, *rasterizer, {}).value();
}

// Whether all of a stone lies farther than `margin` px from borders between tiles.
bool is_far(const Ring& ring, int tile, cv::Size size, double margin) {
  const auto near = [&](double v, int end) {
    const double border = std::round(v / tile) * tile;
    return border > 0 && border < end && std::fabs(v - border) <= margin;
  };
  for (const Point p : ring)
    if (near(p.x, size.width) || near(p.y, size.height)) return false;
  return true;
}

// As a file has it.
std::string text_of(const Piece& piece) {
  std::string text;
  append_colour(text, piece.fill);
  for (const Point p : piece.outline.outer) append_point(text += ' ', p, ',');
  return text;
}

std::set<std::string> texts_far_from_borders(const Output& output, const Case& c) {
  std::set<std::string> texts;
  for (const Piece& piece : output.sheet.pieces)
    if (is_far(piece.outline.outer, c.params.tiles, c.drawing.size(), kSameBeyond * c.params.half_side))
      texts.insert(text_of(piece));
  return texts;
}

// Among thousands of specks one stone or another may be about to be tangled, where little decides (tiles.h).
TEST(Tiles, StonesFarFromBordersAreThoseOfTheWhole) {
  for (const Case& c : cases()) {
    const auto whole = texts_far_from_borders(at_once(c.drawing, c.params, c.seed), c);
    const auto tiled = texts_far_from_borders(in_tiles(c.drawing, c.params, c.seed), c);
    EXPECT_GT(whole.size(), 500U) << c.name;
    std::vector<std::string> differ;
    std::set_symmetric_difference(whole.begin(), whole.end(), tiled.begin(), tiled.end(), std::back_inserter(differ));
    const auto most = static_cast<std::size_t>(c.may_differ * static_cast<double>(whole.size() + tiled.size()));
    EXPECT_LE(differ.size(), most) << c.name << ' ' << testing::PrintToString(differ);
  }
}

// How many of the points of a grid near tile borders lie in no stone, and in more than one.
struct Cover {
  double none = 0, more = 0, points = 0;
};

Cover cover_at_borders(const Output& output, const Case& c) {
  constexpr int kPerPixel = 3, kBand = 12;  // px
  const cv::Size size = c.drawing.size();
  cv::Mat1b count(size * kPerPixel, 0);
  for (const Piece& piece : output.sheet.pieces) {
    const Ring& ring = piece.outline.outer;
    double left = 1e9, right = 0, top = 1e9, bottom = 0;
    for (const Point p : ring) {
      left = std::min(left, p.x), right = std::max(right, p.x);
      top = std::min(top, p.y), bottom = std::max(bottom, p.y);
    }
    for (int j = static_cast<int>(top * kPerPixel); j < std::min<double>(count.rows, bottom * kPerPixel); ++j) {
      for (int i = static_cast<int>(left * kPerPixel); i < std::min<double>(count.cols, right * kPerPixel); ++i) {
        const Point p{(i + 0.5) / kPerPixel, (j + 0.5) / kPerPixel};
        bool inside = false;
        for (std::size_t k = 0; k < ring.size(); ++k) {
          const Point a = ring[k], b = ring[(k + 1) % ring.size()];
          if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
        }
        count(j, i) += inside;
      }
    }
  }
  Cover cover;
  for (int j = 0; j < count.rows; ++j) {
    for (int i = 0; i < count.cols; ++i) {
      if (is_far({{static_cast<double>(i) / kPerPixel, static_cast<double>(j) / kPerPixel}}, c.params.tiles, size,
                 kBand))
        continue;
      ++cover.points;
      cover.none += count(j, i) == 0;
      cover.more += count(j, i) > 1;
    }
  }
  return cover;
}

// Straightened sides leave slivers of gaps and of overlaps everywhere; at borders there are no more of them.
TEST(Tiles, StonesJoinWithoutSeam) {
  for (Case c : cases()) {
    c.params.grout = 0;
    const Cover whole = cover_at_borders(at_once(c.drawing, c.params, c.seed), c);
    const Cover tiled = cover_at_borders(in_tiles(c.drawing, c.params, c.seed), c);
    ASSERT_GT(whole.points, 1e4);
    EXPECT_LE(tiled.none, whole.none + 0.0005 * whole.points) << c.name;
    EXPECT_LE(tiled.more, whole.more + 0.0005 * whole.points) << c.name;
  }
}

TEST(Tiles, OneTileIsTheWhole) {
  const Case c = cases().front();
  Params params = c.params;
  params.tiles = 1000;
  const Output whole = at_once(c.drawing, params, 1), tiled = in_tiles(c.drawing, params, 1);
  ASSERT_EQ(tiled.sheet.pieces.size(), whole.sheet.pieces.size());
  for (std::size_t i = 0; i < whole.sheet.pieces.size(); ++i)
    EXPECT_EQ(text_of(tiled.sheet.pieces[i]), text_of(whole.sheet.pieces[i]));
}

TEST(Tiles, SmallDrawingsArePavedAsAWhole) {
  for (const NamedDrawing& drawing : all_drawings()) {
    const Params params = params_with(4, 256, drawing.colors);
    EXPECT_EQ(in_tiles(drawing.picture, params, 1).sheet.pieces.size(),
              at_once(drawing.picture, params, 1).sheet.pieces.size())
        << drawing.name;
  }
}

TEST(Tiles, SameForAnyNumberOfThreads) {
  const int threads = cv::getNumThreads();
  const Case c = cases().front();
  cv::setNumThreads(1);
  const Output one = in_tiles(c.drawing, c.params, 1);
  cv::setNumThreads(4);
  const Output four = in_tiles(c.drawing, c.params, 1);
  cv::setNumThreads(threads);
  ASSERT_EQ(one.sheet.pieces.size(), four.sheet.pieces.size());
  for (std::size_t i = 0; i < one.sheet.pieces.size(); ++i)
    EXPECT_EQ(one.sheet.pieces[i].outline.outer, four.sheet.pieces[i].outline.outer);
}

// Breaks off after so many rows in all.
class BrokenRows : public RowsOfView {
 public:
  BrokenRows(const ImageView& view, int rows) : RowsOfView(view), left_(rows) {}
  Result<void> read(int rows, std::uint8_t* pixels) override {
    if ((left_ -= rows) < 0) return fail(StatusCode::kInvalidInput, "drawing", "is cut short");
    return RowsOfView::read(rows, pixels);
  }

 private:
  int left_;
};

TEST(Tiles, ErrorsOfRowsAndOfWhoTakesStonesAreHandedOn) {
  const Case c = cases().front();
  const auto rasterizer = make_cpu_rasterizer();
  const TakePart take = [](Output) -> Result<void> { return {}; };
  for (const int rows : {0, 600, 1500, 2000}) {
    BrokenRows broken(view_of(c.drawing), rows);
    const auto done = run_tiles(broken, c.params, 1, *rasterizer, {}, take);
    ASSERT_FALSE(done) << rows;
    EXPECT_EQ(done.error().message, "is cut short");
  }
  RowsOfView rows(view_of(c.drawing));
  const auto full = run_tiles(rows, c.params, 1, *rasterizer, {},
                              [](Output) -> Result<void> { return fail(StatusCode::kUnwritable, "x", "is full"); });
  ASSERT_FALSE(full);
  EXPECT_EQ(full.error().message, "is full");
  const std::atomic<int> stop{static_cast<int>(StopReason::kCancelled)};
  RunContext context;
  context.stop = &stop;
  const auto stopped = run_tiles(rows, c.params, 1, *rasterizer, context, take);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, StatusCode::kCancelled);
}

}  // namespace
}  // namespace tessera::pavement
