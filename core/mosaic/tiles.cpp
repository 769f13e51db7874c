#include "tessera/mosaic/tiles.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>

#include "tessera/base/portable_math.h"
#include "tessera/mosaic/push_apart.h"
#include "tessera/mosaic/vertices.h"
#include "tessera/tessellation/match_corners.h"
#include "tessera/tessellation/relax.h"
#include "tessera/tessellation/separate.h"

namespace tessera::mosaic {
namespace {

constexpr double kWideAngle = 172;    // degrees: wider corners of a quadrilateral tile are left out
constexpr double kGroutShare = 0.12;  // of a tile's side: what grout takes of it at most, on each side
constexpr int kEllipseVertices = 24;
constexpr double kWrittenParts = 1000;  // of a pixel: what files say; tiles are outlines still when rounded to it

std::vector<Ring> quadrilaterals(const Diagram& diagram, const Fields& fields) {
  Tessellation t = place_vertices(diagram, fields);
  std::vector<char> flat = match_corners(t);
  relax(t, flat, [&](int vertex, Point p) { return back_to_edge(t, fields, vertex, p); },
        {.rounds = 60, .pull = 0.05, .squareness = 0.5, .gap = 0.004, .overlap = 0.0003, .frontiers_too = true});
  return separate_pieces(t, flat, kWideAngle);
}

// Centre and half sides of a tile that takes `delta` of its site's space.
struct Frame {
  Frame(const Site& site, double delta) : centre{site.x, site.y} {
    const SinCos turn = sin_cos(site.angle);
    u = (delta * site.extent_u) * Point{turn.cos, turn.sin};
    v = (delta * site.extent_v) * Point{-turn.sin, turn.cos};
  }

  Point centre, u, v;
};

Ring rectangle(const Frame& f) {
  return {f.centre - f.u - f.v, f.centre + f.u - f.v, f.centre + f.u + f.v, f.centre - f.u + f.v};
}

Ring ellipse(const Frame& f) {
  Ring ring;
  for (int k = 0; k < kEllipseVertices; ++k) {
    const SinCos way = sin_cos(2 * kPi * k / kEllipseVertices);
    ring.push_back(f.centre + way.cos * f.u + way.sin * f.v);
  }
  return ring;
}

// ring(i) for each of `count` tiles, in the files' precision.
template <class RingOf>
std::vector<Ring> each_tile(std::size_t count, const RingOf& ring_of) {
  std::vector<Ring> rings(count);
  cv::parallel_for_({0, static_cast<int>(count)}, [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) rings[i] = rounded_outline(ring_of(i), kWrittenParts);
  });
  return rings;
}

Ring without_grout(const Ring& ring, double grout) {
  return inset(ring, std::min(0.5 * grout, kGroutShare * std::sqrt(std::fabs(signed_area(ring)))));
}

std::vector<Ring> fitted_cells(const std::vector<Ring>& cells, const Params& params) {
  return each_tile(cells.size(), [&](int i) { return without_grout(cells[i], params.grout); });
}

// Cut where they would leave their cells, or moved apart.
std::vector<Ring> rectangles(const Diagram& diagram, const Fields& fields, const Params& params) {
  Sites sites(diagram.sites.begin(), diagram.sites.begin() + diagram.own);
  if (!params.clip) {
    push_apart(sites, params.delta, fields.torus);
    return each_tile(diagram.own, [&](int i) { return rectangle({sites[i], params.delta}); });
  }
  const std::vector<Ring> cells = quadrilaterals(diagram, fields);
  return each_tile(diagram.own, [&](int i) {
    return clip_convex(rectangle({sites[i], params.delta}), without_grout(cells[i], params.grout));
  });
}

}  // namespace

std::vector<Ring> shape_tiles(const Diagram& diagram, const Fields& fields, const Params& params) {
  switch (params.shape) {
    case Shape::kQuad: return fitted_cells(quadrilaterals(diagram, fields), params);
    case Shape::kCell: return fitted_cells(whole_cells(place_vertices(diagram, fields)), params);
    case Shape::kEllipse:
      return each_tile(diagram.own, [&](int i) { return ellipse({diagram.sites[i], params.delta}); });
    case Shape::kSquare:
    case Shape::kRectangle: break;
  }
  return rectangles(diagram, fields, params);
}

}  // namespace tessera::mosaic
