#include "tessera/gpu/site_mesh.h"

#include <cmath>

#include "tessera/base/portable_math.h"

namespace tessera {
namespace {

void add_triangle(SiteMesh& mesh, int a, int b, int c) {
  for (const int i : {a, b, c}) mesh.triangles.push_back(static_cast<std::uint16_t>(i));
}

void add_quad(SiteMesh& mesh, int a, int b, int c, int d) {
  add_triangle(mesh, a, b, c);
  add_triangle(mesh, a, c, d);
}

// Corners counted from (+, +), each a quarter turn on.
struct Corner {
  float u, v;
};
constexpr Corner kCorners[4] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};

SiteMesh frustum_mesh(int segments) {
  SiteMesh mesh;
  // A facet's ends lie too far out and its middle too far in, by the same factor.
  const double step = kPi / 2 / segments;
  const double middle = sin_cos(step / 2).cos;
  const double radius = 1 / std::sqrt(middle);
  mesh.coverage = static_cast<float>(radius * middle);

  const int stride = segments + 3;  // vertices a corner: ridge, border, arc
  const auto ridge = [&](int corner) { return corner % 4 * stride; };
  const auto border = [&](int corner) { return ridge(corner) + 1; };
  const auto arc = [&](int corner, int i) { return ridge(corner) + 2 + i; };
  for (int corner = 0; corner < 4; ++corner) {
    const auto [u, v] = kCorners[corner];
    mesh.vertices.push_back({u, v, 0, 0, -1});
    mesh.vertices.push_back({u, v, 0, 0, 0});
    for (int i = 0; i <= segments; ++i) {
      const SinCos turn = sin_cos(corner * (kPi / 2) + i * step);
      mesh.vertices.push_back(
          {u, v, static_cast<float>(radius * turn.cos), static_cast<float>(radius * turn.sin), 1});
    }
    for (int i = 0; i < segments; ++i) add_triangle(mesh, border(corner), arc(corner, i), arc(corner, i + 1));
    add_quad(mesh, border(corner), arc(corner, segments), arc(corner + 1, 0), border(corner + 1));
    add_quad(mesh, border(corner), border(corner + 1), ridge(corner + 1), ridge(corner));
  }
  return mesh;
}

SiteMesh pyramid_mesh() {
  SiteMesh mesh;
  mesh.vertices.push_back({0, 0, 0, 0, 0});
  for (const auto [u, v] : kCorners) mesh.vertices.push_back({u, v, 0, 0, 1});
  for (int i = 0; i < 4; ++i) add_triangle(mesh, 0, 1 + i, 1 + (i + 1) % 4);
  return mesh;
}

}  // namespace

SiteMesh site_mesh(Metric metric, int segments) {
  return metric == Metric::kFrustum ? frustum_mesh(segments) : pyramid_mesh();
}

}  // namespace tessera
