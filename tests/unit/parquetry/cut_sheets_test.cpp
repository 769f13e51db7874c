// Pieces, their names and labels, and the sheets they are drawn on.
#include "tessera/parquetry/cut_sheets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "scans.h"
#include "tessera/formats/formats.h"
#include "tessera/geometry/inscribed.h"
#include "tessera/parquetry/cut_order.h"
#include "tessera/parquetry/lettering.h"
#include "tessera/parquetry/previews.h"

namespace tessera::parquetry {
namespace {

constexpr double kMmPerPx = 0.2;
constexpr int kSide = 50;  // px of a patch

// A panel, and 4 x 3 patches of which all but one lie on it, turned.
struct Example {
  std::vector<Panel> panels;
  std::vector<Patch> patches;
  std::vector<Placement> placements;
  std::vector<CutPiece> pieces;
  cv::Size size{4 * kSide, 3 * kSide};
};

Example example() {
  Example e;
  Panel panel;
  panel.name = "oak";
  panel.mm_per_px = kMmPerPx;
  panel.scan.create(400, 500);
  paint_wood(panel.scan, {0, 0, 500, 400}, {180, 140, 90}, 1);
  panel.mask = cv::Mat1b(400, 500, static_cast<std::uint8_t>(255));
  panel.fiducials = {{10, 10}, {490, 10}, {490, 390}};
  panel.fiducial_mm = 2;
  e.panels.push_back(panel);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) {
      const double x = kSide * column, y = kSide * row;
      Patch patch;
      patch.row = row, patch.column = column;
      patch.outline.outer = {{x, y}, {x + kSide, y}, {x + kSide, y + kSide}, {x, y + kSide}};
      Placement placement;
      placement.patch = static_cast<int>(e.patches.size());
      placement.panel = row == 2 && column == 3 ? -1 : 0;
      placement.turn_deg = 24.0 * placement.patch;
      placement.from = {x + kSide / 2.0, y + kSide / 2.0};
      placement.to = {60.5 + 110 * column, 70.25 + 110 * row};
      placement.cost = 1000 + placement.patch;
      e.patches.push_back(patch);
      e.placements.push_back(placement);
    }
  e.pieces = pieces_of(e.panels, e.patches, e.placements);
  return e;
}

const DrawingLayer& layer(const Drawing& drawing, const std::string& name) {
  return *std::find_if(drawing.layers.begin(), drawing.layers.end(),
                       [&](const DrawingLayer& l) { return l.name == name; });
}

bool is_inside(const Ring& ring, Point p) {
  bool inside = false;
  Point a = ring.back();
  for (const Point b : ring) {
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    a = b;
  }
  return inside;
}

TEST(ColumnLetters, CountAsSpreadsheetsDo) {
  const std::pair<int, const char*> known[] = {{0, "A"},   {25, "Z"},   {26, "AA"},  {51, "AZ"},
                                               {52, "BA"}, {701, "ZZ"}, {702, "AAA"}};
  for (const auto& [column, letters] : known) EXPECT_EQ(column_letters(column), letters);
}

TEST(PiecesOf, HaveNamesAndMeasures) {
  const Example e = example();
  ASSERT_EQ(e.pieces.size(), 11U);  // one has no wood
  EXPECT_EQ(e.pieces[0].id, "A1");
  EXPECT_EQ(e.pieces[6].id, "C2");
  for (const CutPiece& piece : e.pieces) {
    EXPECT_NEAR(piece.area_mm2, 100, 1e-9);
    EXPECT_NEAR(piece.min_width_mm, 10, 0.021);
    EXPECT_GE(piece.grain_deg, 0);
    EXPECT_LT(piece.grain_deg, 180);
  }
  EXPECT_NEAR(e.pieces[6].centroid_mm.x, 280.5 * kMmPerPx, 1e-9);
  EXPECT_NEAR(e.pieces[6].centroid_mm.y, 180.25 * kMmPerPx, 1e-9);
  // Grain along the panel's x turns with the piece.
  for (const CutPiece& piece : e.pieces) {
    const double off = std::abs(piece.grain_deg - std::fmod(piece.turn_deg, 180));
    EXPECT_LT(std::min(off, 180 - off), 12) << piece.id;
  }
}

TEST(PiecesOf, QuartersAndTargetsHaveNamesOfTheirOwn) {
  Example e = example();
  e.patches[1].row = 0, e.patches[1].column = 0;
  EXPECT_EQ(pieces_of(e.panels, e.patches, e.placements)[0].id, "A1a");
  EXPECT_EQ(pieces_of(e.panels, e.patches, e.placements)[1].id, "A1b");
  for (std::size_t i = 6; i < 12; ++i) e.patches[i].target = 1;
  std::set<std::string> ids;
  for (const CutPiece& piece : pieces_of(e.panels, e.patches, e.placements)) ids.insert(piece.id);
  EXPECT_EQ(ids.size(), 11U);
  EXPECT_TRUE(ids.count("2-C2"));
}

TEST(CutSheet, HasEveryPieceOnceWithKerfAndLabelInside) {
  const Example e = example();
  for (const Side side : {Side::kBack, Side::kFront}) {
    Params params;
    params.side = side;
    params.kerf_mm = 0.4;
    const CutSheet sheet = cut_sheet(e.panels, 0, e.pieces, params);
    EXPECT_NEAR(sheet.drawing.width, 100, 1e-9);
    EXPECT_NEAR(sheet.drawing.height, 80, 1e-9);
    std::map<std::string, Ring> cuts;
    for (const Stroke& cut : layer(sheet.drawing, "cut").strokes) {
      EXPECT_TRUE(cut.closed);
      ASSERT_EQ(cut.lines.size(), 1U);
      EXPECT_TRUE(cuts.emplace(cut.id, cut.lines[0]).second);
    }
    ASSERT_EQ(cuts.size(), 11U);
    for (const CutPiece& piece : e.pieces) {
      const Ring& ring = cuts.at("cut-" + piece.id);
      EXPECT_NEAR(area({ring, {}}), 10.4 * 10.4, 0.01);
      const Point middle = centroid(ring);
      EXPECT_NEAR(middle.x, side == Side::kBack ? 100 - piece.centroid_mm.x : piece.centroid_mm.x, 1e-3);
      EXPECT_NEAR(middle.y, piece.centroid_mm.y, 1e-3);
    }
    EXPECT_NEAR(sheet.cut_mm, 11 * 4 * 10.4, 0.1);
    for (const Stroke& label : layer(sheet.drawing, "engrave").strokes) {
      const Ring& ring = cuts.at("cut-" + label.id.substr(6));
      ASSERT_FALSE(label.lines.empty());
      EXPECT_FALSE(label.closed);
      for (const auto& line : label.lines)
        for (const Point p : line) EXPECT_TRUE(is_inside(ring, p)) << label.id;
    }
    EXPECT_EQ(layer(sheet.drawing, "fiducials").strokes.size(), 3U);
    EXPECT_EQ(sheet.drawing.layers.back().name, "cut");  // what is loose cannot be engraved
  }
}

TEST(CutSheet, LiesWhereThePanelLies) {
  Example e = example();
  e.panels[0].registered = true;
  e.panels[0].to_machine = {0, -1, 1, 0, {200, 10}};  // a quarter turn
  Params params;
  params.side = Side::kFront;
  const Drawing drawing = cut_sheet(e.panels, 0, e.pieces, params).drawing;
  EXPECT_NEAR(drawing.left, 0, 1e-9);
  EXPECT_NEAR(drawing.top, 0, 1e-9);
  EXPECT_NEAR(drawing.width, 200, 1e-9);
  EXPECT_NEAR(drawing.height, 110, 1e-9);
  for (const Stroke& cut : layer(drawing, "cut").strokes)
    if (cut.id == "cut-C2") {
      EXPECT_NEAR(centroid(cut.lines[0]).x, 200 - 180.25 * kMmPerPx, 1e-3);
      EXPECT_NEAR(centroid(cut.lines[0]).y, 10 + 280.5 * kMmPerPx, 1e-3);
    }
}

TEST(Assembly, IsSeenFromTheSideThatIsCut) {
  const Example e = example();
  for (const Side side : {Side::kBack, Side::kFront}) {
    Params params;
    params.side = side;
    const Drawing drawing = assembly(e.pieces, {}, {e.size}, kMmPerPx, params);
    EXPECT_NEAR(drawing.width, 40, 1e-9);
    EXPECT_NEAR(drawing.height, 30, 1e-9);
    const auto& outlines = layer(drawing, "outlines").strokes;
    ASSERT_EQ(outlines.size(), 11U);
    EXPECT_EQ(outlines[0].id, "piece-A1");
    EXPECT_NEAR(centroid(outlines[0].lines[0]).x, side == Side::kBack ? 35 : 5, 1e-9);
    EXPECT_TRUE(drawing.pages.empty());
  }
}

TEST(Assembly, IsPrintedOnPagesThatCoverIt) {
  const Example e = example();
  const Drawing drawing = assembly(e.pieces, {}, {e.size}, 2, {});  // 400 x 300 mm
  EXPECT_EQ(drawing.pages.size(), 6U);
  double right = 0, bottom = 0;
  for (const Page& page : drawing.pages) {
    right = std::max(right, page.left + page.width);
    bottom = std::max(bottom, page.top + page.height);
  }
  EXPECT_GE(right, drawing.width);
  EXPECT_GE(bottom, drawing.height);
}

// Several targets lie side by side, each mirrored by itself and on a page of its own.
TEST(Assembly, HasEveryTargetOnce) {
  Example e = example();
  for (std::size_t i = 0; i < 12; ++i) {
    Patch again = e.patches[i];
    again.target = 1;
    Placement placement = e.placements[i];
    placement.patch += 12;
    e.patches.push_back(again);
    e.placements.push_back(placement);
  }
  e.pieces = pieces_of(e.panels, e.patches, e.placements);
  const std::vector<MissingPiece> missing = missing_of(e.patches, e.placements);
  const cv::Size wider(e.size.width + kSide, e.size.height);
  const Drawing drawing = assembly(e.pieces, missing, {e.size, wider}, kMmPerPx, {});
  EXPECT_NEAR(drawing.width, 40 + 50, 1e-9);
  EXPECT_NEAR(drawing.height, 30, 1e-9);
  ASSERT_EQ(drawing.pages.size(), 2U);
  EXPECT_NEAR(drawing.pages[0].width, 40, 1e-9);
  EXPECT_NEAR(drawing.pages[1].left, 40, 1e-9);
  EXPECT_NEAR(drawing.pages[1].width, 50, 1e-9);
  const auto& outlines = layer(drawing, "outlines").strokes;
  ASSERT_EQ(outlines.size(), 22U);
  EXPECT_EQ(outlines[0].id, "piece-1-A1");
  EXPECT_EQ(outlines[11].id, "piece-2-A1");
  EXPECT_NEAR(centroid(outlines[0].lines[0]).x, 35, 1e-9);
  EXPECT_NEAR(centroid(outlines[11].lines[0]).x, 40 + 45, 1e-9);
  const auto& gaps = layer(drawing, "missing");
  EXPECT_GT(gaps.dash, 0);
  ASSERT_EQ(gaps.strokes.size(), 2U);
  EXPECT_EQ(gaps.strokes[1].id, "missing-2-D3");
  EXPECT_NEAR(centroid(gaps.strokes[1].lines[0]).x, 40 + 15, 1e-9);
  EXPECT_NE(write_svg(drawing).find("stroke-dasharray=\"1.5\""), std::string::npos);
}

TEST(Lettering, FitsAnyPiece) {
  Rng rng(3, RngPurpose::kShapes);
  for (int round = 0; round < 200; ++round) {
    Ring ring;
    for (int k = 0; k < 9; ++k) {
      const SinCos turn = sin_cos(k * 2 * kPi / 9);
      const double radius = rng.uniform(2, 12);
      ring.push_back({radius * turn.cos, radius * turn.sin});
    }
    for (const char* text : {"A1", "AB123d", "2-Z9", "W"}) {
      const auto lines = label_in({ring, {}}, text, 5);
      ASSERT_FALSE(lines.empty());
      double top = 1e9, bottom = -1e9;
      for (const auto& line : lines)
        for (const Point p : line) {
          EXPECT_TRUE(is_inside(ring, p)) << text;
          top = std::min(top, p.y), bottom = std::max(bottom, p.y);
        }
      EXPECT_LE(bottom - top, 5.001 * 25 / 21);  // some letters reach below the line
    }
  }
}

TEST(Lettering, LettersAreTheirOwn) {
  std::set<std::size_t> points;
  const Lettering a = letter("A"), b = letter("B"), both = letter("AB");
  EXPECT_EQ(both.lines.size(), a.lines.size() + b.lines.size());
  EXPECT_GT(both.width, a.width + b.width);
  EXPECT_NEAR(a.height, 1, 0.01);
  EXPECT_TRUE(letter("").lines.empty());
  EXPECT_TRUE(letter(" ").lines.empty());
}

TEST(ShortTour, VisitsAllAndIsShort) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng(seed, RngPurpose::kShapes);
    std::vector<Point> places;
    for (int k = 0; k < 120; ++k) places.push_back({rng.uniform(0, 300), rng.uniform(0, 200)});
    const auto tour = short_tour(places);
    EXPECT_EQ(std::set<std::size_t>(tour.begin(), tour.end()).size(), places.size());
    double way = 0;
    for (std::size_t i = 1; i < tour.size(); ++i) way += length(places[tour[i]] - places[tour[i - 1]]);
    // Beardwood, Halton and Hammersley: 0.7124 sqrt(n A), and somewhat more for so few places near a border.
    EXPECT_LT(way, 1.15 * 0.7124 * std::sqrt(120.0 * 300 * 200) * (1 + 0.33 / std::sqrt(120.0) * 2)) << seed;
  }
  EXPECT_TRUE(short_tour({}).empty());
}

TEST(FinishedPreview, ShowsTheWoodWhereItWillLie) {
  Example e = example();
  for (Placement& placement : e.placements) placement.turn_deg = 0;
  e.pieces = pieces_of(e.panels, e.patches, e.placements);
  const Raster preview = finished_preview(e.panels, e.pieces, 1, e.size);
  ASSERT_EQ(preview.width, 200);
  ASSERT_EQ(preview.height, 150);
  const auto red = [&](int x, int y) { return preview.bytes[3 * (static_cast<std::size_t>(y) * 200 + x)]; };
  // B1's middle, (75, 25), is from (170.5, 70.25): half a pixel between columns, a quarter between rows.
  const cv::Mat3b& scan = e.panels[0].scan;
  const double expected = (3 * (scan(70, 170)[0] + scan(70, 171)[0]) + scan(71, 170)[0] + scan(71, 171)[0]) / 8.0;
  EXPECT_NEAR(red(75, 25), expected, 1);
  EXPECT_EQ(red(199, 149), 160);  // no wood
}

}  // namespace
}  // namespace tessera::parquetry
