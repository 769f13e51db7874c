#include "tessera/parquetry/cut_sheets.h"

#include <algorithm>
#include <cmath>

#include "tessera/base/portable_math.h"
#include "tessera/geometry/offset.h"
#include "tessera/parquetry/cut_order.h"
#include "tessera/parquetry/lettering.h"
#include "tessera/parquetry/panels.h"

namespace tessera::parquetry {
namespace {

constexpr double kHairlineMm = 0.01;
constexpr double kLargestLabelMm = 5;
constexpr Rgb kCut{255, 0, 0}, kEngrave{0, 0, 255}, kFiducial{0, 255, 0}, kOutline{0, 0, 0}, kLabel{90, 90, 90};

template <class Map>
Polygon mapped(const Polygon& outline, const Map& map) {
  Polygon result = outline;
  for (Point& p : result.outer) p = map(p);
  for (Ring& hole : result.holes)
    for (Point& p : hole) p = map(p);
  if (signed_area(result.outer) < 0) {  // mirrored
    std::reverse(result.outer.begin(), result.outer.end());
    for (Ring& hole : result.holes) std::reverse(hole.begin(), hole.end());
  }
  return result;
}

Ring circle(Point centre, double radius) {
  constexpr int kSides = 48;
  Ring ring;
  for (int k = 0; k < kSides; ++k) {
    const SinCos turn = sin_cos(2 * kPi * k / kSides);
    ring.push_back(centre + Point{radius * turn.cos, radius * turn.sin});
  }
  return ring;
}

// The panel's sheet; on a machine it begins at the machine's origin, since programs tend to ignore where a drawing
// begins.
void set_frame(const Panel& panel, Side side, Drawing& drawing) {
  const double w = panel.scan.cols, h = panel.scan.rows;
  Point low = on_sheet(panel, side, {0, 0}), high = low;
  for (const Point corner : {Point{w, 0}, {w, h}, {0, h}}) {
    const Point p = on_sheet(panel, side, corner);
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  if (panel.registered) low = {std::min(low.x, 0.0), std::min(low.y, 0.0)};
  drawing.left = low.x, drawing.top = low.y;
  drawing.width = high.x - low.x, drawing.height = high.y - low.y;
}

Stroke label(const std::string& id, const Polygon& outline) {
  return {"label-" + id, label_in(outline, id, kLargestLabelMm), false};
}

Stroke outline_of(const std::string& id, const Polygon& outline) {
  Stroke stroke{id, {outline.outer}, true};
  for (const Ring& hole : outline.holes) stroke.lines.push_back(hole);
  return stroke;
}

// A target of this size at `left`, mm, on sheets of A4.
void append_pages(double left, double width, double height, std::vector<Page>& pages) {
  constexpr double kWide = 190, kHigh = 277;  // what a printer reaches
  constexpr double kRest = 1e-9;
  for (int row = 0; row * kHigh < height - kRest; ++row)
    for (int column = 0; column * kWide < width - kRest; ++column) {
      const double x = column * kWide, y = row * kHigh;
      pages.push_back({left + x, y, std::min(kWide, width - x), std::min(kHigh, height - y)});
    }
}

}  // namespace

CutSheet cut_sheet(const std::vector<Panel>& panels, std::size_t panel, const std::vector<CutPiece>& pieces,
                   const Params& params) {
  const Panel& wood = panels[panel];
  const auto to_sheet = [&](Point px) { return on_sheet(wood, params.side, px); };
  CutSheet sheet;
  set_frame(wood, params.side, sheet.drawing);
  DrawingLayer engrave{"engrave", kEngrave, kHairlineMm, {}}, cut{"cut", kCut, kHairlineMm, {}},
      fiducials{"fiducials", kFiducial, kHairlineMm, {}};
  std::vector<const CutPiece*> own;
  std::vector<Polygon> outlines;
  std::vector<Point> middles;
  for (const CutPiece& piece : pieces) {
    if (piece.panel != panel) continue;
    own.push_back(&piece);
    outlines.push_back(mapped(piece.on_panel, to_sheet));
    middles.push_back(centroid(outlines.back().outer));
  }
  Point head{sheet.drawing.left, sheet.drawing.top};
  for (const std::size_t i : short_tour(middles)) {
    engrave.strokes.push_back(label(own[i]->id, outlines[i]));
    const Polygon path = grown(outlines[i], params.kerf_mm / 2);
    Stroke stroke{"cut-" + own[i]->id, {}, true};
    const auto append = [&](const Ring& ring) {
      stroke.lines.push_back(begun_near(ring, head));
      sheet.travel_mm += length(stroke.lines.back().front() - head);
      sheet.cut_mm += perimeter(ring);
      head = stroke.lines.back().front();
    };
    for (const Ring& hole : path.holes) append(hole);
    append(path.outer);
    cut.strokes.push_back(std::move(stroke));
  }
  for (std::size_t k = 0; k < wood.fiducials.size(); ++k)
    fiducials.strokes.push_back(
        {"mark-" + std::to_string(k + 1), {circle(to_sheet(wood.fiducials[k]), wood.fiducial_mm / 2)}, true});
  sheet.drawing.layers = {std::move(engrave), std::move(fiducials), std::move(cut)};
  return sheet;
}

Drawing assembly(const std::vector<CutPiece>& pieces, const std::vector<MissingPiece>& missing,
                 const std::vector<cv::Size>& targets, double mm_per_px, const Params& params) {
  const std::vector<int> lefts = side_by_side(targets);
  Drawing drawing;
  drawing.width = lefts.back() * mm_per_px;
  for (const cv::Size& target : targets) drawing.height = std::max(drawing.height, target.height * mm_per_px);
  const auto seen = [&](const Polygon& finished, int target) {
    const auto i = static_cast<std::size_t>(target - 1);
    const double left = lefts[i], width = targets[i].width;
    const bool mirrored = params.side == Side::kBack;
    return mapped(finished, [&](Point px) {
      return mm_per_px * Point{left + (mirrored ? width - px.x : px.x), px.y};
    });
  };
  DrawingLayer gaps{"missing", kLabel, 0.2, {}, /*dash=*/1.5};
  DrawingLayer outlines{"outlines", kOutline, 0.2, {}}, labels{"labels", kLabel, 0.2, {}};
  for (const MissingPiece& piece : missing)
    gaps.strokes.push_back(outline_of("missing-" + piece.id, seen(piece.finished, piece.target)));
  for (const CutPiece& piece : pieces) {
    const Polygon outline = seen(piece.finished, piece.target);
    outlines.strokes.push_back(outline_of("piece-" + piece.id, outline));
    labels.strokes.push_back(label(piece.id, outline));
  }
  drawing.layers = {std::move(gaps), std::move(outlines), std::move(labels)};
  for (std::size_t i = 0; i < targets.size(); ++i)
    append_pages(lefts[i] * mm_per_px, targets[i].width * mm_per_px, targets[i].height * mm_per_px, drawing.pages);
  if (drawing.pages.size() == 1) drawing.pages.clear();
  return drawing;
}

}  // namespace tessera::parquetry
