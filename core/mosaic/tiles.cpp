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
constexpr double kMostTaper = 0.6;  // of a trapezoid: how much its longer side may exceed the mean of both
constexpr double kLong = 1.5;       // ratio of a cell's second moments above which its own axes are plain
// What is no chip: less of a cell's area than this, or narrower, against the cell's side and in px.
constexpr double kChipArea = 0.02, kChipWidth = 0.06, kLeastChipWidth = 0.5;
constexpr double kWrittenParts = 1000;  // of a pixel: what files say; tiles are outlines still when rounded to it

std::vector<Ring> quadrilaterals(const Diagram& diagram, const Fields& fields) {
  Tessellation t = place_vertices(diagram, fields);
  std::vector<char> flat = match_corners(t);
  relax(t, flat, [&](int vertex, Point p) { return back_to_edge(t, fields, vertex, p); },
        {.rounds = 60, .pull = 0.05, .squareness = 0.5, .gap = 0.004, .overlap = 0.0003, .frontiers_too = true});
  return separate_pieces(t, flat, kWideAngle);
}

// Of an area of density 1 / area.
struct Moments {
  Point centre;
  double xx = 0, xy = 0, yy = 0;  // about the centre
};

// By triangles from the centre (Green's theorem).
Moments second_moments(const Ring& ring) {
  Moments m;
  m.centre = centroid(ring);
  double area = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i] - m.centre, b = ring[i + 1 < ring.size() ? i + 1 : 0] - m.centre;
    const double part = 0.5 * cross(a, b);
    area += part;
    m.xx += part / 6 * (a.x * a.x + a.x * b.x + b.x * b.x);
    m.yy += part / 6 * (a.y * a.y + a.y * b.y + b.y * b.y);
    m.xy += part / 12 * (2 * a.x * a.y + a.x * b.y + b.x * a.y + 2 * b.x * b.y);
  }
  if (area <= 0) return {m.centre};
  m.xx /= area, m.yy /= area, m.xy /= area;
  return m;
}

// Centre and half sides of a tile, that takes `delta` of its site's space or is given. A taper is how much longer the
// one of two opposite sides is than their mean, and the other shorter: of the sides along u, from -v to v, and along
// v.
struct Frame {
  Frame(Point at, Point half_u, Point half_v) : centre(at), u(half_u), v(half_v) {}
  Frame(const Site& site, double delta) : centre{site.x, site.y} {
    const SinCos turn = sin_cos(site.angle);
    u = (delta * site.extent_u) * Point{turn.cos, turn.sin};
    v = (delta * site.extent_v) * Point{-turn.sin, turn.cos};
  }

  Point centre, u, v;
  double taper_u = 0, taper_v = 0;
};

// The rectangle whose second moments are `delta` squared times those of the cell: along the cell's principal axes
// where it is clearly longer than wide, else along its site's.
Frame moment_frame(const Ring& cell, Point axis, double delta) {
  const Moments m = second_moments(cell);
  const double mean = 0.5 * (m.xx + m.yy), half = 0.5 * (m.xx - m.yy), apart = std::sqrt(half * half + m.xy * m.xy);
  if (mean + apart > kLong * (mean - apart)) {
    const SinCos turn = sin_cos(0.5 * atan2_portable(2 * m.xy, m.xx - m.yy));
    axis = {turn.cos, turn.sin};
  }
  // A rectangle of half side a has the second moment a^2 / 3.
  const auto half_side = [&](Point way) {
    return delta *
           std::sqrt(3 * std::max(0.0, way.x * way.x * m.xx + 2 * way.x * way.y * m.xy + way.y * way.y * m.yy));
  };
  const Point across{-axis.y, axis.x};
  return {m.centre, half_side(axis) * axis, half_side(across) * across};
}

// 8.1: rows fan out by the divergence of their direction, which for a field of unit vectors at the angle a is how a
// changes along the rows. The field counts modulo a right angle, so that rows may run along u or v: along the one on
// whose way more changes. The centre of gravity stays the site.
Frame trapezoid_frame(const Site& site, const DirectionField& direction, double delta) {
  Frame frame(site, delta);
  const SinCos turn = sin_cos(site.angle);
  const auto turned = [&](Point from, Point to) {
    const double quarters = (direction.angle(to.x, to.y) - direction.angle(from.x, from.y)) / (kPi / 2);
    return kPi / 2 * (quarters - std::round(quarters));
  };
  const auto turned_along = [&](Point half) {
    const Point before = frame.centre - half, after = frame.centre + half;
    return (turned(before, frame.centre) + turned(frame.centre, after)) / (2 * length(half));
  };
  const double v = length(frame.u) * turned_along(site.extent_v * Point{-turn.sin, turn.cos}),
               u = -length(frame.v) * turned_along(site.extent_u * Point{turn.cos, turn.sin});
  if (std::fabs(v) >= std::fabs(u)) {
    frame.taper_v = std::clamp(v, -kMostTaper, kMostTaper);
  } else {
    frame.taper_u = std::clamp(u, -kMostTaper, kMostTaper);
  }
  frame.centre = frame.centre - frame.taper_v / 3 * frame.u - frame.taper_u / 3 * frame.v;
  return frame;
}

Ring corners(const Frame& f) {
  const auto corner = [&](double u, double v) {
    return f.centre + u * (1 + v * f.taper_u) * f.u + v * (1 + u * f.taper_v) * f.v;
  };
  return {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)};
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

// What is left of a cell beyond each side of its tile, `grout` away from it; inside the sides before.
std::vector<Ring> chips_of(const Ring& cell, const Ring& tile, double grout) {
  std::vector<Ring> chips;
  const double size = std::fabs(signed_area(cell)), far = 4 * std::sqrt(size) + 2 * perimeter(tile);
  Ring rest = cell;
  for (std::size_t k = 0; k < 4 && rest.size() >= 3; ++k) {
    const Point way = tile[(k + 1) % 4] - tile[k];
    if (dot(way, way) == 0) break;
    const Point along = (far / length(way)) * way, out{along.y, -along.x};
    const Point on = tile[k], off = tile[k] + (grout / far) * out;
    const Ring chip = clip_convex({off - along + out, off + along + out, off + along, off - along}, rest);
    rest = clip_convex({on - along, on + along, on + along - out, on - along - out}, rest);
    const double area = std::fabs(signed_area(chip)), girth = perimeter(chip);
    if (chip.size() < 3 || area < kChipArea * size) continue;
    if (2 * area / girth >= std::max(kLeastChipWidth, kChipWidth * std::sqrt(size))) chips.push_back(chip);
  }
  return chips;
}

void add_chips(const std::vector<Ring>& cells, const std::vector<Ring>& whole, double grout,
               std::vector<Ring>& tiles) {
  std::vector<Ring> chips;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const double between = std::min(grout, 2 * kGroutShare * std::sqrt(std::fabs(signed_area(cells[i]))));
    for (Ring& chip : chips_of(cells[i], whole[i], between)) chips.push_back(std::move(chip));
  }
  for (Ring& chip : each_tile(chips.size(), [&](int i) { return chips[i]; })) tiles.push_back(std::move(chip));
}

Frame frame_of(const Site& site, const Fields& fields, const Params& params) {
  if (params.shape == Shape::kTrapezoid) return trapezoid_frame(site, fields.direction, params.delta);
  return {site, params.delta};
}

std::vector<Ring> whole_rectangles(Sites sites, const Fields& fields, const Params& params) {
  push_apart(sites, params.delta, fields.torus);
  return each_tile(sites.size(), [&](int i) { return corners(frame_of(sites[i], fields, params)); });
}

// Cut where they would leave their cells.
std::vector<Ring> rectangles(const Diagram& diagram, const Fields& fields, const Params& params) {
  std::vector<Ring> cells = quadrilaterals(diagram, fields);
  std::vector<Ring> whole;
  for (int i = 0; i < diagram.own; ++i) {
    const Frame space = frame_of(diagram.sites[i], fields, params);
    const bool fitted = params.shape == Shape::kMoment && cells[i].size() >= 3;
    whole.push_back(corners(fitted ? moment_frame(cells[i], (1 / length(space.u)) * space.u, params.delta) : space));
    cells[i] = without_grout(cells[i], params.grout);
  }
  std::vector<Ring> tiles = each_tile(whole.size(), [&](int i) { return clip_convex(whole[i], cells[i]); });
  if (params.chips) add_chips(cells, whole, params.grout, tiles);
  return tiles;
}

}  // namespace

std::vector<Ring> shape_tiles(const Diagram& diagram, const Fields& fields, const Params& params) {
  switch (params.shape) {
    case Shape::kQuad: return fitted_cells(quadrilaterals(diagram, fields), params);
    case Shape::kCell: return fitted_cells(whole_cells(place_vertices(diagram, fields)), params);
    case Shape::kEllipse:
      return each_tile(diagram.own, [&](int i) { return ellipse({diagram.sites[i], params.delta}); });
    case Shape::kSquare:
    case Shape::kRectangle:
    case Shape::kTrapezoid:
      if (!params.clip)
        return whole_rectangles({diagram.sites.begin(), diagram.sites.begin() + diagram.own}, fields, params);
      break;
    case Shape::kMoment: break;
  }
  return rectangles(diagram, fields, params);
}

}  // namespace tessera::mosaic
