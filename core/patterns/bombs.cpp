#include "tessera/patterns/bombs.h"

#include <algorithm>
#include <cmath>

#include "tessera/base/distributions.h"
#include "tessera/base/portable_math.h"
#include "tessera/geometry/angle.h"

namespace tessera::patterns {
namespace {

constexpr double kFlatness = 0.1;  // px, between a circle through the vertices and its chords

// The vertices of a regular polygon as large as the circle of radius 1.
Ring unit_circle(double radius) {
  const double wanted = kPi / std::sqrt(2 * kFlatness / std::max(radius, kFlatness));
  const int corners = 4 * std::clamp(static_cast<int>(std::ceil(wanted / 4)), 2, 64);
  const double out = std::sqrt(2 * kPi / (corners * sin_cos(2 * kPi / corners).sin));
  Ring ring;
  for (int k = 0; k < corners; ++k) {
    const SinCos turn = sin_cos(2 * kPi * k / corners);
    ring.push_back({out * turn.cos, out * turn.sin});
  }
  return ring;
}

// A figure of half a unit to each side, and its two measures.
struct Figure {
  Ring shape;  // clockwise on the screen
  double length, breadth;
};

Figure figure_of(const Params& p) {
  const Ring box{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
  const auto circle = [](double diameter) {
    Ring ring = unit_circle(diameter / 2);
    for (Point& corner : ring) corner = 0.5 * corner;
    return ring;
  };
  switch (p.model) {
    case Model::kSegments: return {box, p.length, 2 * p.dot};
    case Model::kEllipses: return {circle(std::max(p.length, p.breadth)), p.length, p.breadth};
    case Model::kCircles: return {circle(p.length), p.length, p.length};
    case Model::kPixels: return {box, 1, 1};
    default: return {box, p.length, p.breadth};
  }
}

double drawn_size(double variation, Rng& rng) {
  return variation > 0 ? draw_gamma(1 / (variation * variation), rng) : 1;
}

}  // namespace

bool is_bombing(Model model) {
  return model == Model::kSegments || model == Model::kEllipses || model == Model::kCircles ||
         model == Model::kRectangles || model == Model::kPixels;
}

double bomb_reach(const Params& params) {
  const Figure figure = figure_of(params);
  const double v = params.model == Model::kPixels ? 0 : params.size_variation;
  return std::hypot(figure.length, figure.breadth) / 2 * (1 + 5 * v + 14 * v * v);
}

Cells drop_bombs(const std::vector<Point>& centres, const Params& params, Rng& rng) {
  const Figure figure = figure_of(params);
  const bool is_round = params.model == Model::kCircles, is_pixel = params.model == Model::kPixels;
  Cells cells;
  if (figure.length <= 0 || figure.breadth <= 0) return cells;
  cells.reserve(centres.size());
  for (Point centre : centres) {
    if (is_pixel) centre = {std::floor(centre.x) + 0.5, std::floor(centre.y) + 0.5};
    const Angle angle = is_round || is_pixel ? Angle{} : Angle::of(rng.uniform(0, kPi));
    const double scale = is_pixel ? 1 : drawn_size(params.size_variation, rng);
    Ring ring = figure.shape;
    for (Point& p : ring) p = centre + angle.turned({scale * figure.length * p.x, scale * figure.breadth * p.y});
    cells.push_back(std::move(ring));
  }
  return cells;
}

Cells draw_points(const std::vector<Point>& points, double radius) {
  const Ring shape = unit_circle(radius);
  Cells cells;
  cells.reserve(points.size());
  for (const Point point : points) {
    Ring ring = shape;
    for (Point& p : ring) p = point + radius * p;
    cells.push_back(std::move(ring));
  }
  return cells;
}

}  // namespace tessera::patterns
