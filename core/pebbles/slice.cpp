#include "tessera/pebbles/slice.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tessera/base/portable_math.h"

namespace tessera::pebbles {
namespace {

// The paper's values (section 4).
constexpr double kA = 0.65, kB = 0.5;       // of Eq. 3
constexpr int kAngleSteps = 100;            // alpha_T from 1 towards 0
constexpr std::size_t kLeastVertices = 10;  // of P
constexpr int kGapVertices = 5;             // of a Bezier curve
constexpr int kRadii = 360;

constexpr int kMostRounds = 20;  // until the centre is taken as it is

cv::Point pixel_of(Point p) { return {static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y))}; }

const Vertex& at(const std::vector<Vertex>& vertices, std::size_t k, int offset) {
  const auto count = static_cast<std::ptrdiff_t>(vertices.size());
  return vertices[static_cast<std::size_t>((static_cast<std::ptrdiff_t>(k) + offset + 2 * count) % count)];
}

// Where the rays end, each pixel once. A ray that leaves the picture met no edge and leaves a gap.
std::vector<Vertex> shoot(const Mask& mask, cv::Point from) {
  std::vector<Vertex> vertices;
  bool gap = false;
  for (const cv::Point hit : mask.hits(from)) {
    const Point place{hit.x + 0.5, hit.y + 0.5};
    if (!mask.inside(hit)) {
      gap = true;
    } else if (gap || vertices.empty() || !(vertices.back().place == place)) {
      vertices.push_back({place, gap});
      gap = false;
    }
  }
  if (gap && !vertices.empty()) vertices[0].after_gap = true;
  if (vertices.size() > 1 && vertices.back().place == vertices[0].place) vertices.pop_back();
  return vertices;
}

struct Side {
  Point way;
  double length;
  Side(Point from, Point to) : way(to - from), length(tessera::length(way)) {}
};

// Eq. 3, both of its lines. Which way a turn is positive is left open by the paper; here it is away from the centre:
// what reaches out through a gap of the edge is critical, and so are the acute corners that the paper says it loses.
// The other sign would eat up the edge on both sides of the gap.
bool is_critical(const Side& in, const Side& out, double angle_threshold) {
  const double scale = angle_threshold * in.length * out.length;
  return dot(in.way, out.way) < kA * scale && -cross(in.way, out.way) < kB * scale;
}

// Takes out critical vertices until there are none, or too few of the others.
std::vector<Vertex> without_critical(std::vector<Vertex> vertices, double angle_threshold) {
  std::vector<Vertex> kept;
  for (bool again = true; again && vertices.size() >= kLeastVertices;) {
    kept.clear();
    bool gap = false;
    Side in(vertices.back().place, vertices[0].place);
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const Side out(vertices[k].place, vertices[k + 1 < vertices.size() ? k + 1 : 0].place);
      gap |= vertices[k].after_gap;
      if (is_critical(in, out, angle_threshold)) {
        gap = true;
      } else {
        kept.push_back({vertices[k].place, gap});
        gap = false;
      }
      in = out;
    }
    if (gap && !kept.empty()) kept[0].after_gap = true;
    again = kept.size() < vertices.size();
    vertices.swap(kept);
  }
  return vertices;
}

Point unit(Point v) { return (1 / length(v)) * v; }

// The cubic curve from b to c, in the directions of a to b and c to d; where these belong to an arc of a circle, the
// curve is one: control points are chord / (3 cos^2(angle / 4)) away, of the angle between the two directions.
void add_curve(Point a, Point b, Point c, Point d, Ring& ring) {
  if (a == b || b == c || c == d) return;
  const Point leaving = unit(b - a), arriving = unit(d - c);
  const double cos_half = std::sqrt(std::max(0.0, (1 + dot(leaving, arriving)) / 2));
  const double reach = 2 * length(c - b) / (3 * (1 + cos_half));
  const Point first = b + reach * leaving, second = c - reach * arriving;
  for (int k = 1; k <= kGapVertices; ++k) {
    const double t = static_cast<double>(k) / (kGapVertices + 1), s = 1 - t;
    ring.push_back(s * s * s * b + 3 * s * s * t * first + 3 * s * t * t * second + t * t * t * c);
  }
}

// The radius in each direction up to the ring, where it is met first. None: somewhere it is not met.
std::optional<std::vector<double>> radii_of(const Ring& ring, Point centre) {
  std::vector<double> radii(kRadii);
  for (int k = 0; k < kRadii; ++k) {
    const SinCos turn = sin_cos(2 * kPi * k / kRadii);
    const Point way{turn.cos, turn.sin};
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point p = ring[i] - centre, q = ring[i + 1 < ring.size() ? i + 1 : 0] - centre;
      const double before = cross(way, p), after = cross(way, q);
      if ((before < 0) == (after < 0)) continue;
      const double r = dot(way, p) + before / (before - after) * dot(way, q - p);
      if (r > 0 && (radii[k] == 0 || r < radii[k])) radii[k] = r;
    }
    if (radii[k] == 0) return {};
  }
  return radii;
}

}  // namespace

// alpha_T is the largest that leaves enough vertices. Most samples in the gaps have none, which the least one tells.
std::vector<Vertex> edges_around(const Mask& mask, cv::Point from) {
  const std::vector<Vertex> all = shoot(mask, from);
  std::vector<Vertex> least = without_critical(all, 1.0 / kAngleSteps);
  if (least.size() < kLeastVertices) return {};
  for (int step = kAngleSteps; step > 1; --step) {
    std::vector<Vertex> kept = without_critical(all, static_cast<double>(step) / kAngleSteps);
    if (kept.size() >= kLeastVertices) return kept;
  }
  return least;
}

Ring closed(const std::vector<Vertex>& vertices) {
  Ring ring;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    if (vertices[k].after_gap)
      add_curve(at(vertices, k, -2).place, at(vertices, k, -1).place, vertices[k].place, at(vertices, k, 1).place,
                ring);
    ring.push_back(vertices[k].place);
  }
  return ring;
}

std::optional<Slice> find_slice(const Mask& mask, cv::Point from) {
  Ring ring;
  cv::Point origin = from;
  for (int round = 0; round < kMostRounds; ++round) {
    const std::vector<Vertex> vertices = edges_around(mask, from);
    if (vertices.empty()) return {};
    ring = closed(vertices);
    origin = from;
    Ring known;
    for (const Vertex& v : vertices) known.push_back(v.place);
    from = pixel_of(centroid(known));
    // On an edge, of texture say, no ray can begin: the curve is what it was.
    if (from == origin || !mask.inside(from) || !mask.free(from)) break;
  }
  const Point centre = centroid(ring);
  std::optional<std::vector<double>> radii = radii_of(ring, centre);
  if (!radii) return {};
  return Slice{{0, centre, *std::move(radii), 0}, origin};
}

}  // namespace tessera::pebbles
