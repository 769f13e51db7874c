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

Drawing assembly(const std::vector<CutPiece>& pieces, int target, cv::Size size, double mm_per_px,
                 const Params& params) {
  Drawing drawing;
  drawing.width = size.width * mm_per_px;
  drawing.height = size.height * mm_per_px;
  const bool mirrored = params.side == Side::kBack;
  const auto seen = [&](Point px) { return mm_per_px * (mirrored ? Point{size.width - px.x, px.y} : px); };
  DrawingLayer outlines{"outlines", kOutline, 0.2, {}}, labels{"labels", kLabel, 0.2, {}};
  for (const CutPiece& piece : pieces) {
    if (piece.target != target) continue;
    const Polygon outline = mapped(piece.finished, seen);
    Stroke stroke{"piece-" + piece.id, {outline.outer}, true};
    for (const Ring& hole : outline.holes) stroke.lines.push_back(hole);
    outlines.strokes.push_back(std::move(stroke));
    labels.strokes.push_back(label(piece.id, outline));
  }
  drawing.layers = {std::move(outlines), std::move(labels)};
  constexpr double kWide = 190, kHigh = 277;  // what a printer reaches of A4
  const int across = static_cast<int>(std::ceil(drawing.width / kWide - 1e-9));
  const int down = static_cast<int>(std::ceil(drawing.height / kHigh - 1e-9));
  for (int row = 0; row < down && across * down > 1; ++row)
    for (int column = 0; column < across; ++column)
      drawing.pages.push_back({column * kWide, row * kHigh, kWide, kHigh});
  return drawing;
}

}  // namespace tessera::parquetry
