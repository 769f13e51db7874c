#include "tessera/mosaic/tiles.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>

#include "tessera/base/portable_math.h"
#include "tessera/mosaic/vertices.h"
#include "tessera/tessellation/match_corners.h"
#include "tessera/tessellation/relax.h"
#include "tessera/tessellation/separate.h"

namespace tessera::mosaic {
namespace {

constexpr double kWideAngle = 172;    // degrees: wider corners of a quadrilateral tile are left out
constexpr double kGroutShare = 0.12;  // of a tile's side: what grout takes of it at most, on each side
constexpr int kEllipseVertices = 24;

std::vector<Ring> quadrilaterals(const Diagram& diagram, const Fields& fields) {
  Tessellation t = place_vertices(diagram, fields);
  std::vector<char> flat = match_corners(t);
  relax(t, flat, [&](int vertex, Point p) { return back_to_edge(t, fields, vertex, p); },
        {.rounds = 120, .pull = 0.05, .squareness = 0.5, .gap = 0.004, .overlap = 0.0003, .frontiers_too = true});
  return separate_pieces(t, flat, kWideAngle);
}

Ring rectangle(const Site& site, double delta) {
  const SinCos turn = sin_cos(site.angle);
  const Point centre{site.x, site.y}, u = (delta * site.extent_u) * Point{turn.cos, turn.sin},
                                      v = (delta * site.extent_v) * Point{-turn.sin, turn.cos};
  return {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
}

Ring ellipse(const Site& site, double delta) {
  const SinCos turn = sin_cos(site.angle);
  const Point centre{site.x, site.y}, u = (delta * site.extent_u) * Point{turn.cos, turn.sin},
                                      v = (delta * site.extent_v) * Point{-turn.sin, turn.cos};
  Ring ring;
  for (int k = 0; k < kEllipseVertices; ++k) {
    const SinCos way = sin_cos(2 * kPi * k / kEllipseVertices);
    ring.push_back(centre + way.cos * u + way.sin * v);
  }
  return ring;
}

}  // namespace

std::vector<Ring> shape_tiles(const Diagram& diagram, const Fields& fields, const Params& params) {
  const bool from_cells = params.shape == Shape::kQuad || params.shape == Shape::kCell;
  const bool clipped = (params.shape == Shape::kSquare || params.shape == Shape::kRectangle) && params.clip;
  std::vector<Ring> cells;
  if (params.shape == Shape::kCell) cells = whole_cells(place_vertices(diagram, fields));
  if (params.shape == Shape::kQuad || clipped) cells = quadrilaterals(diagram, fields);
  if (!from_cells && !clipped) cells.resize(diagram.sites.size());
  cv::parallel_for_({0, static_cast<int>(cells.size())}, [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) {
      Ring& ring = cells[i];
      if (from_cells) {
        const double side = std::sqrt(std::fabs(signed_area(ring)));
        ring = inset(ring, std::min(0.5 * params.grout, kGroutShare * side));
      } else if (i >= static_cast<int>(diagram.sites.size())) {
        ring.clear();
      } else if (params.shape == Shape::kEllipse) {
        ring = ellipse(diagram.sites[i], params.delta);
      } else {
        Ring whole = rectangle(diagram.sites[i], params.delta);
        ring = clipped ? clip_convex(whole, ring) : std::move(whole);
      }
    }
  });
  return cells;
}

}  // namespace tessera::mosaic
