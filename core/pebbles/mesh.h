// Section 2.1 and 3.3: pebbles as generalized ellipsoids. Lengths are source pixels, y up, x and z the picture's x
// and y.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "tessera/base/portable_math.h"
#include "tessera/geometry/mesh.h"
#include "tessera/pebbles/params.h"
#include "tessera/pebbles/pebble.h"

namespace tessera::pebbles {

// A positive function of (phi, theta) at one place, with its derivatives.
struct SemiAxis {
  double value = 1, by_phi = 0, by_theta = 0;
};

struct SurfacePoint {
  glm::dvec3 position, normal;  // the normal outward and of any length; zero at the poles
};

// Equation 1 with any f, g, h; the normal is the cross product of its derivatives.
SurfacePoint generalized_ellipsoid(SinCos phi, SinCos theta, const SemiAxis& f, const SemiAxis& g, const SemiAxis& h);

// Vertices of a mesh: two poles and, between them, parallels - 1 rings of `meridians`. V = 2 + N (M - 1), T = 2 N (M
// - 1).
struct Detail {
  int meridians = 8;  // N, even
  int parallels = 4;  // M, even: one ring is the equator
};

// Of a pebble of `radius` px within `error` px (> 0): N >= pi sqrt(R / (2 e)) would do for a circle. Outlines are
// none and get twice as many meridians; sections from pole to pole are ellipses, and M is half of what does for a
// circle. Each level of detail after the first (0) has half of both. At least 8 x 4.
Detail detail_of(double radius, double error, int lod);

// r(phi) in `count` directions, from any number of them: between them linear; of more, their mean around each.
std::vector<double> resampled(const std::vector<double>& radii, int count);

// Half a pebble's height: h of equation 4.
double half_height(const std::vector<double>& radii, Height kind);

// What a mesh is made of.
struct Body {
  std::vector<double> radii;  // r(phi), one a meridian
  double height = 1;          // h: from the equator to the top
  double flatten = 0;         // 0..1: how much of the lower half is missing
};

// The triangles of such meshes: two to each field between rings, one to each at a pole; the seam closes by index
// modulo N. Vertex 0 is the upper pole, ring j has the vertices 1 + N (j - 1) + i, the lower pole comes last.
std::vector<std::uint32_t> body_triangles(Detail detail);

// The body around (0, 0, 0), the centre of its outline at the height of its equator: positions and normals only, for
// body_triangles({body.radii.size(), parallels}).
Mesh body_mesh(const Body& body, int parallels);

// A convex hull of it of at most 32 vertices, all of them within it; for body_triangles(hull_detail(hull)).
Mesh body_hull(const Body& body);
Detail hull_detail(const Mesh& hull);

struct Solid {
  double volume = 0;
  glm::dvec3 centre{0};  // of mass
};
Solid measure(const Mesh& mesh);

// Normals from the triangles around each vertex, for vertices that have been moved.
void average_normals(Mesh& mesh);

// Turns normals outward, away from `centre`, where a triangle faces against the sum of its vertices' normals: on
// outlines that leap from one direction to the next.
void mend_normals(Mesh& mesh, const glm::dvec3& centre);

}  // namespace tessera::pebbles
