#include "tessera/pebbles/mesh.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "stones.h"

namespace tessera::pebbles {
namespace {

using testing::DoubleNear;
using testing::Each;
using testing::ElementsAre;
using testing::Pointwise;

Mesh body_of(const std::vector<double>& radii, double height, double flatten, Detail detail) {
  Mesh mesh = body_mesh({resampled(radii, detail.meridians), height, flatten}, detail.parallels);
  mesh.indices = std::make_shared<const std::vector<std::uint32_t>>(body_triangles(detail));
  return mesh;
}

Mesh hull_of(const Body& body) {
  Mesh hull = body_hull(body);
  hull.indices = std::make_shared<const std::vector<std::uint32_t>>(body_triangles(hull_detail(hull)));
  return hull;
}

glm::dvec3 face_normal(const Mesh& mesh, std::size_t t) {
  const auto at = [&](std::size_t k) { return glm::dvec3(mesh.positions[(*mesh.indices)[t + k]]); };
  return glm::cross(at(1) - at(0), at(2) - at(0));
}

int triangles_against_their_normals(const Mesh& mesh) {
  int count = 0;
  for (std::size_t t = 0; t < mesh.indices->size(); t += 3) {
    glm::dvec3 normals(0);
    for (std::size_t k = t; k < t + 3; ++k) normals += glm::dvec3(mesh.normals[(*mesh.indices)[k]]);
    count += glm::dot(face_normal(mesh, t), normals) <= 0;
  }
  return count;
}

TEST(Detail, HasAtLeastTheMeridiansOfACircleAndHalvesThem) {
  for (const double radius : {1.0, 8.0, 23.0, 100.0, 1500.0})
    for (const double error : {0.1, 0.5, 3.0}) {
      const Detail finest = detail_of(radius, error, 0);
      EXPECT_GE(finest.meridians, kPi * std::sqrt(radius / (2 * error)));
      for (int lod = 0; lod <= 3; ++lod) {
        const Detail detail = detail_of(radius, error, lod);
        EXPECT_EQ(detail.meridians % 2, 0);
        EXPECT_EQ(detail.parallels % 2, 0);
        EXPECT_GE(detail.meridians, 8);
        EXPECT_GE(detail.parallels, 4);
        EXPECT_LE(detail.meridians, std::max(8, finest.meridians >> lod));
        EXPECT_GE(detail.meridians, (finest.meridians >> lod) - 2);
      }
    }
}

TEST(Resampled, TheSameNumberIsTheSameAndAConstantStaysOne) {
  const std::vector<double> radii = rough(1, 10, 0.5, 24);
  EXPECT_THAT(resampled(radii, 24), Pointwise(DoubleNear(1e-12), radii));
  for (const int count : {3, 8, 20, 24, 25, 360})
    EXPECT_THAT(resampled({5, 5, 5, 5, 5, 5, 5}, count), Each(DoubleNear(5, 1e-12)));
}

TEST(Resampled, MoreAreBetweenNeighboursAroundTheSeamToo) {
  EXPECT_THAT(resampled({1, 2, 4, 3}, 8), ElementsAre(1, 1.5, 2, 3, 4, 3.5, 3, 2));
}

TEST(HalfHeight, OfAnEllipseIsItsMinorAxis) {
  const std::vector<double> radii = ellipse(20, 12, 360);
  EXPECT_NEAR(half_height(radii, Height::kMinorAxis), 12, 0.01);
  EXPECT_NEAR(half_height(radii, Height::kLeast), 12, 1e-9);
  EXPECT_NEAR(half_height(radii, Height::kPercentile), 12, 0.1);
}

TEST(HalfHeight, OneBadRaySpoilsTheLeastOnly) {
  std::vector<double> radii = ellipse(20, 20, 64);
  radii[7] = 1;
  EXPECT_EQ(half_height(radii, Height::kLeast), 1);
  EXPECT_EQ(half_height(radii, Height::kPercentile), 20);
  EXPECT_GT(half_height(radii, Height::kMinorAxis), 19);
}

// f, g and h of equation 1, all of them of both parameters.
SurfacePoint some_surface(double phi, double theta) {
  const SinCos p = sin_cos(phi), t = sin_cos(theta), p2 = sin_cos(2 * phi);
  return generalized_ellipsoid(p, t, {3 + 0.4 * p2.sin + 0.2 * t.sin, 0.8 * p2.cos, 0.2 * t.cos},
                               {2 + 0.3 * p2.cos - 0.1 * t.cos, -0.6 * p2.sin, 0.1 * t.sin},
                               {1.5 + 0.2 * p.sin * t.cos, 0.2 * p.cos * t.cos, -0.2 * p.sin * t.sin});
}

TEST(GeneralizedEllipsoid, NormalsAreThoseOfFiniteDifferences) {
  constexpr double kStep = 1e-5;
  for (double phi = 0.05; phi < 2 * kPi; phi += 0.37)
    for (double theta = -1.4; theta < 1.5; theta += 0.31) {
      const auto at = [&](double dp, double dt) { return some_surface(phi + dp, theta + dt).position; };
      const glm::dvec3 by_phi = (at(kStep, 0) - at(-kStep, 0)) / (2 * kStep);
      const glm::dvec3 by_theta = (at(0, kStep) - at(0, -kStep)) / (2 * kStep);
      const SurfacePoint point = some_surface(phi, theta);
      const glm::dvec3 expected = glm::normalize(glm::cross(by_theta, by_phi));
      EXPECT_LT(glm::distance(glm::normalize(point.normal), expected), 1e-6);
      EXPECT_GT(glm::dot(point.normal, point.position), 0);
    }
}

TEST(GeneralizedEllipsoid, NormalsOfEquation4AreTheCorrectedOnes) {
  const double r = 5, slope = 1.7, h = 3;
  for (double phi = 0; phi < 6; phi += 0.7)
    for (double theta = -1.5; theta < 1.5; theta += 0.3) {
      const SinCos p = sin_cos(phi), t = sin_cos(theta);
      const glm::dvec3 expected(h * (r * p.cos + slope * p.sin) * t.cos, r * r * t.sin,
                                h * (r * p.sin - slope * p.cos) * t.cos);
      const SurfacePoint point = generalized_ellipsoid(p, t, {r, slope, 0}, {r, slope, 0}, {h, 0, 0});
      EXPECT_LT(glm::distance(glm::normalize(point.normal), glm::normalize(expected)), 1e-9);
    }
}

TEST(BodyMesh, HasTheSizesOfClosedFormsAtEachLevelOfDetail) {
  for (int lod = 0; lod <= 3; ++lod) {
    const Detail detail = detail_of(60, 0.5, lod);
    const Mesh mesh = body_of(ellipse(60, 40, 64), 30, 0, detail);
    const int n = detail.meridians, m = detail.parallels;
    EXPECT_EQ(static_cast<int>(mesh.positions.size()), 2 + n * (m - 1));
    EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
    EXPECT_EQ(static_cast<int>(mesh.indices->size()), 3 * 2 * n * (m - 1));
    EXPECT_EQ(*std::max_element(mesh.indices->begin(), mesh.indices->end()) + 1, mesh.positions.size());
  }
}

TEST(BodyMesh, IsAnEllipsoidOverAnEllipse) {
  const Mesh mesh = body_of(ellipse(20, 12, 128), 9, 0, {128, 64});
  const Solid solid = measure(mesh);
  EXPECT_NEAR(solid.volume / (4 * kPi / 3 * 20 * 12 * 9), 1, 2e-3);
  EXPECT_LT(glm::length(solid.centre), 1e-4);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const glm::dvec3 p(mesh.positions[v]), gradient(p.x / 400, p.y / 81, p.z / 144);
    EXPECT_NEAR(glm::dot(p, gradient), 1, 1e-5);
    EXPECT_LT(glm::distance(glm::dvec3(mesh.normals[v]), glm::normalize(gradient)), 3e-3);
  }
}

TEST(BodyMesh, PolesAreOneVertexEachAndTheSeamIsNone) {
  const Detail detail{12, 6};
  const Mesh mesh = body_of(ellipse(5, 4, 12), 3, 0, detail);
  EXPECT_EQ(mesh.positions.front(), glm::vec3(0, 3, 0));
  EXPECT_EQ(mesh.positions.back(), glm::vec3(0, -3, 0));
  EXPECT_EQ(mesh.normals.front(), glm::vec3(0, 1, 0));
  EXPECT_EQ(mesh.normals.back(), glm::vec3(0, -1, 0));
  EXPECT_EQ(std::count(mesh.indices->begin(), mesh.indices->end(), 0U), 12);
  for (std::size_t a = 0; a < mesh.positions.size(); ++a)
    for (std::size_t b = a + 1; b < mesh.positions.size(); ++b)
      EXPECT_GT(glm::distance(mesh.positions[a], mesh.positions[b]), 0.1f);
}

TEST(BodyMesh, IsClosedAndFacesOutwardOverManyRoughOutlines) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
    for (const double flatten : {0.0, 0.3, 1.0})
      for (const int lod : {0, 2}) {
        const Detail detail = detail_of(30, 0.5, lod);
        Mesh mesh = body_of(rough(seed, 30, 0.35, 64), 12, flatten, detail);
        mend_normals(mesh, {0, 3, 0});
        ASSERT_TRUE(is_closed(*mesh.indices));
        ASSERT_GT(measure(mesh).volume, 0);
        ASSERT_EQ(triangles_against_their_normals(mesh), 0) << seed << ' ' << flatten << ' ' << lod;
        for (const glm::vec3& normal : mesh.normals) ASSERT_NEAR(glm::length(normal), 1, 1e-5);
      }
}

TEST(BodyMesh, FlattenCutsTheLowerHalfLevelAndKeepsTheUpper) {
  const Detail detail{32, 32};
  const Mesh whole = body_of(ellipse(10, 8, 32), 6, 0, detail);
  double before = measure(whole).volume;
  for (const double flatten : {0.25, 0.5, 0.75, 1.0}) {
    const Mesh mesh = body_of(ellipse(10, 8, 32), 6, flatten, detail);
    const double volume = measure(mesh).volume;
    EXPECT_LT(volume, before);
    before = volume;
    EXPECT_NEAR(mesh.positions.back().y, -6 * (1 - flatten), 1e-6);
    const std::size_t upper = 1 + 32 * 16;  // down to the equator
    EXPECT_TRUE(std::equal(mesh.positions.begin(), mesh.positions.begin() + upper, whole.positions.begin()));
    for (const glm::vec3& p : mesh.positions) EXPECT_GE(p.y, -6 * (1 - flatten) - 1e-6);
  }
  EXPECT_NEAR(before / measure(whole).volume, 0.5, 1e-3);
}

TEST(BodyMesh, NormalsOfAFlattenedOneAreThoseOfItsTriangles) {
  Mesh mesh = body_of(ellipse(10, 8, 64), 6, 0.5, {64, 128});
  Mesh expected = mesh;
  average_normals(expected);
  for (std::size_t v = 0; v < mesh.normals.size(); ++v)
    EXPECT_GT(glm::dot(mesh.normals[v], expected.normals[v]), 0.99f);
}

TEST(BodyHull, IsConvexClosedAndHasAtMost32VerticesOverManyRoughOutlines) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
    for (const double flatten : {0.0, 0.4}) {
      const Mesh hull = hull_of({rough(seed, 30, 0.3, 48), 9, flatten});
      ASSERT_LE(hull.positions.size(), 32U);
      ASSERT_TRUE(is_closed(*hull.indices));
      ASSERT_GT(measure(hull).volume, 0);
      for (std::size_t t = 0; t < hull.indices->size(); t += 3) {
        const glm::dvec3 normal = glm::normalize(face_normal(hull, t)), on(hull.positions[(*hull.indices)[t]]);
        for (const glm::vec3& p : hull.positions) ASSERT_LT(glm::dot(normal, glm::dvec3(p) - on), 1e-3) << seed;
      }
    }
}

TEST(BodyHull, HoldsMostOfAnEllipsoid) {
  EXPECT_GT(measure(hull_of({ellipse(20, 12, 64), 9, 0})).volume, 0.7 * (4 * kPi / 3 * 20 * 12 * 9));
}

}  // namespace
}  // namespace tessera::pebbles
