#include "tessera/geometry/extrude.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

#include "../formats/sheets.h"
#include "tessera/geometry/triangulate.h"

namespace tessera {
namespace {

using testing::ElementsAre;

Point vertex_of(const Polygon& polygon, std::size_t index) {
  if (index < polygon.outer.size()) return polygon.outer[index];
  index -= polygon.outer.size();
  std::size_t hole = 0;
  while (index >= polygon.holes[hole].size()) index -= polygon.holes[hole++].size();
  return polygon.holes[hole][index];
}

// Areas that are all positive and add up to the polygon's: nothing is covered twice or left out.
void expect_filled(const Polygon& polygon) {
  const std::vector<std::uint32_t> triangles = triangulate(polygon);
  double sum = 0;
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
    const Ring ring{vertex_of(polygon, triangles[t]), vertex_of(polygon, triangles[t + 1]),
                    vertex_of(polygon, triangles[t + 2])};
    EXPECT_GT(signed_area(ring), 0);
    sum += signed_area(ring);
  }
  EXPECT_NEAR(sum, area(polygon), 1e-9 * area(polygon));
}

TEST(Triangulate, FillsStarsOfEitherSense) {
  for (const int points : {3, 5, 40}) {
    Ring star;
    for (int k = 0; k < 2 * points; ++k) {
      const double angle = 3.14159265 * k / points, radius = k % 2 == 0 ? 10 : 3;
      star.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    expect_filled({star, {}});
    EXPECT_EQ(triangulate({star, {}}).size(), 3 * (star.size() - 2));
    std::reverse(star.begin(), star.end());
    expect_filled({star, {}});
  }
}

TEST(Triangulate, FillsAroundHoles) {
  const auto box = [](double x, double y, double size) {
    return Ring{{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}};
  };
  Polygon sieve{box(0, 0, 10), {}};
  for (int k = 0; k < 9; ++k) sieve.holes.push_back(box(1 + 3 * (k % 3), 1 + 3 * (k / 3), k % 2 == 0 ? 2 : 1));
  std::reverse(sieve.holes[4].begin(), sieve.holes[4].end());
  expect_filled(sieve);
  for (const Piece& piece : random_sheet(7, 10).pieces) expect_filled(piece.outline);
}

TEST(Triangulate, EndsOnARingThatCrossesItself) {
  EXPECT_EQ(triangulate({{{0, 0}, {4, 4}, {4, 0}, {0, 4}, {2, 6}}, {}}).size(), 9U);
}

using Place = std::tuple<float, float, float>;

// How often a side runs from one place to another, less how often it runs back: 0 everywhere in what is closed.
int open_sides(const Mesh& mesh) {
  std::map<std::pair<Place, Place>, int> sides;
  const auto at = [&](std::size_t k) {
    const glm::vec3 p = mesh.positions[(*mesh.indices)[k]];
    return Place{p.x, p.y, p.z};
  };
  for (std::size_t t = 0; t < mesh.indices->size(); t += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const Place from = at(t + k), to = at(t + (k + 1) % 3);
      from < to ? ++sides[{from, to}] : --sides[{to, from}];
    }
  int open = 0;
  for (const auto& [side, balance] : sides) open += balance != 0;
  return open;
}

struct Faces {
  double volume = 0;        // m3
  int against_normals = 0;  // triangles
};

Faces faces_of(const Mesh& mesh) {
  Faces faces;
  for (std::size_t t = 0; t < mesh.indices->size(); t += 3) {
    glm::dvec3 corner[3];
    for (std::size_t k = 0; k < 3; ++k) corner[k] = mesh.positions[(*mesh.indices)[t + k]];
    const glm::dvec3 face = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    faces.volume += glm::dot(corner[0], face) / 6;
    for (std::size_t k = 0; k < 3; ++k) {
      const double along = glm::dot(glm::normalize(face), glm::dvec3(mesh.normals[(*mesh.indices)[t + k]]));
      faces.against_normals += along < 0.99;
    }
  }
  return faces;
}

TEST(Extruded, ASquareIsASlabWithABevel) {
  PieceSheet sheet;
  sheet.layer = "tiles";
  sheet.width = 40;
  sheet.height = 20;
  sheet.width_mm = 400;
  sheet.grout = {9, 8, 7};
  sheet.job_json = R"({"seed":3})";
  sheet.pieces.push_back({1, {{{25, 5}, {35, 5}, {35, 15}, {25, 15}}, {}}, {200, 100, 0}});
  const Scene scene = extruded(sheet);
  ASSERT_EQ(scene.nodes.size(), 2U);
  EXPECT_EQ(scene.nodes[0].name, "tiles");
  EXPECT_EQ(scene.nodes[1].name, "grout");
  EXPECT_THAT(scene.views.front().nodes, ElementsAre(0, 1));
  EXPECT_EQ(scene.job_json, sheet.job_json);

  const Mesh &tile = scene.meshes[0], &bed = scene.meshes[1];
  EXPECT_EQ(tile.indices->size(), 3U * (2 + 8 + 8 + 2));
  EXPECT_EQ(open_sides(tile) + open_sides(bed), 0);
  const double side = 0.1, low = kSlabs.thickness * side, bevel = kSlabs.bevel * side, head = side - 2 * bevel;
  const double volume = side * side * (low - bevel) + bevel / 3 * (side * side + side * head + head * head);
  EXPECT_NEAR(faces_of(tile).volume, volume, 1e-6 * volume);
  EXPECT_NEAR(faces_of(bed).volume, 0.4 * 0.2 * kSlabs.bed * side, 1e-9);
  EXPECT_EQ(faces_of(tile).against_normals + faces_of(bed).against_normals, 0);
  EXPECT_THAT(tile.colours, testing::Each(Rgb{200, 100, 0}));
  EXPECT_THAT(bed.colours, testing::Each(Rgb{9, 8, 7}));
  for (const glm::vec3& p : tile.positions) {  // x right, z down, from the middle
    EXPECT_THAT(p.x, testing::AllOf(testing::Ge(0.05f - 1e-6f), testing::Le(0.15f + 1e-6f)));
    EXPECT_LE(std::fabs(p.z), 0.05f + 1e-6f);
  }
}

TEST(Extruded, PiecesOfAnyFormAreClosedAndFaceOutwards) {
  PieceSheet sheet = random_sheet(5, 12);
  std::reverse(sheet.pieces[3].outline.outer.begin(), sheet.pieces[3].outline.outer.end());
  Ring& ring = sheet.pieces[5].outline.outer;
  ring.insert(ring.begin() + 1, {ring[0], 0.5 * (ring[0] + ring[1])});  // a vertex twice, one on a side
  const Scene scene = extruded(sheet);
  const Mesh& mesh = scene.meshes[0];
  EXPECT_EQ(open_sides(mesh), 0);
  EXPECT_EQ(faces_of(mesh).against_normals, 0);
  EXPECT_EQ(mesh.colours.size(), mesh.positions.size());
  EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
  double covered = 0;
  for (const Piece& piece : sheet.pieces) covered += area(piece.outline) * 1e-6;
  const double size = std::sqrt(covered / static_cast<double>(sheet.pieces.size()));
  EXPECT_LT(faces_of(mesh).volume, covered * kSlabs.thickness * size);
  EXPECT_GT(faces_of(mesh).volume, covered * (kSlabs.thickness - kSlabs.bevel) * size);
}

TEST(Extruded, ASheetWithoutPiecesIsABed) {
  PieceSheet sheet;
  sheet.width = sheet.height = 4;
  const Scene scene = extruded(sheet);
  ASSERT_EQ(scene.nodes.size(), 1U);
  EXPECT_EQ(scene.nodes[0].name, "grout");
  EXPECT_EQ(scene.nodes[0].mesh, 0);
}

}  // namespace
}  // namespace tessera
