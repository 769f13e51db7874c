#include "tessera/pebbles/mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace tessera::pebbles {
namespace {

constexpr int kLeastMeridians = 8, kLeastParallels = 4;
constexpr int kMendRounds = 32;
constexpr int kHullSides = 10, kHullParallels = 4;  // 2 + 10 * 3 = 32 vertices

std::vector<SinCos> directions(int count) {
  std::vector<SinCos> all(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) all[static_cast<std::size_t>(i)] = sin_cos(2 * kPi * i / count);
  return all;
}

// Latitude of ring j of M, from the upper pole; the equator's is exactly 0.
SinCos latitude(int j, int parallels) { return sin_cos(kPi * (parallels - 2 * j) / (2.0 * parallels)); }

// The lesser of s and `level`, rounded off where they meet: its value and derivative. The whole of s where level
// is 1.
struct Levelled {
  double value, slope;
};
Levelled levelled(double s, double level) {
  const double width = std::min(level, 1 - level) / 2;
  if (s <= level - width) return {s, 1};
  if (s >= level + width) return {level, 0};
  const double over = (s - level + width) / (2 * width);
  return {s - over * over * width, 1 - over};
}

// h(theta): constant above; below, flattened bodies stay above a level (a deviation from equation 4, within equation
// 1).
SemiAxis height_at(SinCos theta, const Body& body) {
  if (theta.sin >= 0 || body.flatten == 0) return {body.height, 0, 0};
  const Levelled depth = levelled(-theta.sin, 1 - body.flatten);
  const double h = body.height * depth.value / -theta.sin;
  return {h, 0, (body.height * depth.slope - h) * theta.cos / theta.sin};
}

double lowest(const Body& body) { return -body.height * levelled(1, 1 - body.flatten).value; }

// Moments of the area inside r(phi), in polar coordinates: 1, x, y, xx, xy, yy.
std::array<double, 6> moments(const std::vector<double>& radii) {
  const int n = static_cast<int>(radii.size());
  const std::vector<SinCos> phi = directions(n);
  std::array<double, 6> sum{};
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double r = radii[i], r2 = r * r, c = phi[i].cos, s = phi[i].sin;
    sum[0] += r2 / 2;
    sum[1] += r2 * r / 3 * c;
    sum[2] += r2 * r / 3 * s;
    sum[3] += r2 * r2 / 4 * c * c;
    sum[4] += r2 * r2 / 4 * c * s;
    sum[5] += r2 * r2 / 4 * s * s;
  }
  for (double& v : sum) v *= 2 * kPi / n;
  return sum;
}

// Half the shorter axis of the ellipse that has the outline's second moments.
double half_minor_axis(const std::vector<double>& radii) {
  const std::array<double, 6> m = moments(radii);
  const double x = m[1] / m[0], y = m[2] / m[0];
  const double xx = m[3] / m[0] - x * x, xy = m[4] / m[0] - x * y, yy = m[5] / m[0] - y * y;
  const double spread = std::sqrt((xx - yy) * (xx - yy) / 4 + xy * xy);
  return 2 * std::sqrt(std::max(0.0, (xx + yy) / 2 - spread));
}

// The outline's farthest vertices in a few directions: a convex polygon, clockwise on the screen.
Ring farthest_vertices(const std::vector<double>& radii, int sides) {
  const std::vector<SinCos> phi = directions(static_cast<int>(radii.size()));
  Ring outline, chosen;
  for (std::size_t i = 0; i < radii.size(); ++i) outline.push_back({radii[i] * phi[i].cos, radii[i] * phi[i].sin});
  for (const SinCos& way : directions(sides)) {
    const Point towards{way.cos, way.sin};
    const Point best = *std::max_element(outline.begin(), outline.end(),
                                         [&](Point a, Point b) { return dot(a, towards) < dot(b, towards); });
    if (chosen.empty() || !(chosen.back() == best)) chosen.push_back(best);
  }
  if (chosen.size() > 1 && chosen.front() == chosen.back()) chosen.pop_back();
  return chosen;
}

}  // namespace

SurfacePoint generalized_ellipsoid(SinCos phi, SinCos theta, const SemiAxis& f, const SemiAxis& g,
                                   const SemiAxis& h) {
  const glm::dvec3 position(f.value * phi.cos * theta.cos, h.value * theta.sin, g.value * phi.sin * theta.cos);
  const glm::dvec3 by_phi((f.by_phi * phi.cos - f.value * phi.sin) * theta.cos, h.by_phi * theta.sin,
                          (g.by_phi * phi.sin + g.value * phi.cos) * theta.cos);
  const glm::dvec3 by_theta((f.by_theta * theta.cos - f.value * theta.sin) * phi.cos,
                            h.by_theta * theta.sin + h.value * theta.cos,
                            (g.by_theta * theta.cos - g.value * theta.sin) * phi.sin);
  // Equation 5 as printed has the signs of r' of a z that points the other way, and points inward.
  return {position, glm::cross(by_theta, by_phi)};
}

Detail detail_of(double radius, double error, int lod) {
  const int circle = static_cast<int>(std::ceil(kPi * std::sqrt(radius / (2 * error))));
  return {std::max(kLeastMeridians, circle >> lod << 1),
          std::max(kLeastParallels, (circle + (2 << lod)) >> (lod + 2) << 1)};
}

std::vector<double> resampled(const std::vector<double>& radii, int count) {
  const int n = static_cast<int>(radii.size());
  const double reach = std::max(1.0, static_cast<double>(n) / count);  // half the base of a triangle of weights
  std::vector<double> result;
  for (int k = 0; k < count; ++k) {
    const double at = static_cast<double>(k) * n / count;
    double sum = 0, weights = 0;
    for (int i = static_cast<int>(std::ceil(at - reach)); i < at + reach; ++i) {
      const double weight = 1 - std::fabs(i - at) / reach;
      sum += weight * radii[static_cast<std::size_t>((i + n * count) % n)];
      weights += weight;
    }
    result.push_back(sum / weights);
  }
  return result;
}

double half_height(const std::vector<double>& radii, Height kind) {
  if (kind == Height::kMinorAxis) return half_minor_axis(radii);
  std::vector<double> sorted = radii;
  const auto rank = kind == Height::kLeast ? 0 : static_cast<std::ptrdiff_t>((sorted.size() - 1) / 20);
  std::nth_element(sorted.begin(), sorted.begin() + rank, sorted.end());
  return sorted[static_cast<std::size_t>(rank)];
}

std::vector<std::uint32_t> body_triangles(Detail detail) {
  const auto n = static_cast<std::uint32_t>(detail.meridians),
             rings = static_cast<std::uint32_t>(detail.parallels - 1);
  const std::uint32_t last = 1 + n * rings;
  std::vector<std::uint32_t> indices;
  indices.reserve(std::size_t{6} * n * rings);
  const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    indices.insert(indices.end(), {a, b, c});
  };
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    triangle(0, 1 + next, 1 + i);
    for (std::uint32_t j = 0; j + 1 < rings; ++j) {
      const std::uint32_t upper = 1 + n * j, lower = upper + n;
      triangle(upper + i, upper + next, lower + i);
      triangle(upper + next, lower + next, lower + i);
    }
    triangle(last, last - n + i, last - n + next);
  }
  return indices;
}

Mesh body_mesh(const Body& body, int parallels) {
  const std::size_t n = body.radii.size();
  const std::vector<SinCos> phi = directions(static_cast<int>(n));
  const double step = 2 * kPi / static_cast<double>(n);
  std::vector<SemiAxis> r(n);  // f = g = r(phi), equation 4
  for (std::size_t i = 0; i < n; ++i)
    r[i] = {body.radii[i], (body.radii[(i + 1) % n] - body.radii[(i + n - 1) % n]) / (2 * step), 0};

  Mesh mesh;
  const auto add = [&](const glm::dvec3& position, const glm::dvec3& normal) {
    mesh.positions.emplace_back(position);
    mesh.normals.emplace_back(normal / std::sqrt(glm::dot(normal, normal)));
  };
  mesh.positions.reserve(2 + n * static_cast<std::size_t>(parallels - 1));
  mesh.normals.reserve(mesh.positions.capacity());
  add({0, body.height, 0}, {0, 1, 0});
  for (int j = 1; j < parallels; ++j) {
    const SinCos theta = latitude(j, parallels);
    const SemiAxis h = height_at(theta, body);
    for (std::size_t i = 0; i < n; ++i) {
      const SurfacePoint point = generalized_ellipsoid(phi[i], theta, r[i], r[i], h);
      add(point.position, point.normal);
    }
  }
  add({0, lowest(body), 0}, {0, -1, 0});
  return mesh;
}

// Slices of a generalized ellipsoid are similar to one another and shrink faster and faster towards the poles: over a
// convex outline it is convex.
Mesh body_hull(const Body& body) {
  const Ring ring = farthest_vertices(body.radii, kHullSides);
  Mesh mesh;
  mesh.positions.emplace_back(0, body.height, 0);
  for (int j = 1; j < kHullParallels; ++j) {
    const SinCos theta = latitude(j, kHullParallels);
    const double y = height_at(theta, body).value * theta.sin;
    for (const Point p : ring) mesh.positions.emplace_back(p.x * theta.cos, y, p.y * theta.cos);
  }
  mesh.positions.emplace_back(0, lowest(body), 0);
  return mesh;
}

Detail hull_detail(const Mesh& hull) {
  return {static_cast<int>(hull.positions.size() - 2) / (kHullParallels - 1), kHullParallels};
}

Solid measure(const Mesh& mesh) {
  Solid solid;
  const std::vector<std::uint32_t>& indices = *mesh.indices;
  for (std::size_t t = 0; t + 2 < indices.size(); t += 3) {
    const glm::dvec3 a(mesh.positions[indices[t]]), b(mesh.positions[indices[t + 1]]),
        c(mesh.positions[indices[t + 2]]);
    const double six = glm::dot(a, glm::cross(b, c));  // a tetrahedron with the origin
    solid.volume += six / 6;
    solid.centre += six * (a + b + c);
  }
  if (solid.volume > 0) solid.centre /= 24 * solid.volume;
  return solid;
}

void average_normals(Mesh& mesh) {
  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
  const std::vector<std::uint32_t>& indices = *mesh.indices;
  for (std::size_t t = 0; t + 2 < indices.size(); t += 3) {
    const glm::dvec3 a(mesh.positions[indices[t]]);
    const glm::dvec3 area =
        glm::cross(glm::dvec3(mesh.positions[indices[t + 1]]) - a, glm::dvec3(mesh.positions[indices[t + 2]]) - a);
    for (std::size_t k = t; k < t + 3; ++k) sums[indices[k]] += area;
  }
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const double length = std::sqrt(glm::dot(sums[v], sums[v]));
    if (length > 0) mesh.normals[v] = glm::vec3(sums[v] / length);
  }
}

void mend_normals(Mesh& mesh, const glm::dvec3& centre) {
  const std::vector<std::uint32_t>& indices = *mesh.indices;
  const auto at = [&](std::size_t corner) { return glm::dvec3(mesh.positions[indices[corner]]); };
  bool mended = true;
  for (int round = 0; mended && round < kMendRounds; ++round) {
    mended = false;
    for (std::size_t t = 0; t + 2 < indices.size(); t += 3) {
      glm::dvec3 normals(0);
      for (std::size_t k = t; k < t + 3; ++k) normals += glm::dvec3(mesh.normals[indices[k]]);
      if (glm::dot(glm::cross(at(t + 1) - at(t), at(t + 2) - at(t)), normals) > 0) continue;
      for (std::size_t k = t; k < t + 3; ++k) {
        glm::vec3& normal = mesh.normals[indices[k]];
        normal = glm::vec3(glm::normalize(glm::dvec3(normal) + glm::normalize(at(k) - centre)));
      }
      mended = true;
    }
  }
}

}  // namespace tessera::pebbles
