#include "tessera/view/read_gltf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <random>

#include "tessera/formats/formats.h"
#include "tessera/view/placed_mesh.h"

namespace tessera::view {
namespace {

// Two tetrahedra, one strewn three times, on a surface with a picture; and what only a physics engine sees.
Scene example(bool quantize) {
  Scene scene;
  scene.quantize = quantize;
  Texture picture{32, 16, std::vector<std::uint8_t>(3 * 32 * 16, 140), true};
  scene.textures.push_back(picture);
  scene.surfaces.push_back({.name = "stone", .roughness = 0.5, .colour = 0});
  scene.surfaces.push_back({.name = "hulls", .visible = false});
  const auto indices = std::make_shared<const std::vector<std::uint32_t>>(
      std::vector<std::uint32_t>{0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0});
  for (const float size : {1.0F, 2.0F}) {
    Mesh mesh;
    mesh.name = size == 1 ? "small" : "large";
    mesh.positions = {{size, 0, 0}, {0, size, 0}, {0, 0, size}, {-size, -size, -size}};
    for (const glm::vec3& p : mesh.positions) mesh.normals.push_back(glm::normalize(p));
    mesh.texture_coordinates = {{0, 0}, {1, 0}, {0, 1}, {0.5F, 0.25F}};
    mesh.colours = {{0, 1, 2}, {255, 254, 128}, {10, 20, 30}, {99, 100, 101}};
    mesh.indices = indices;
    mesh.surface = 0;
    scene.meshes.push_back(mesh);
  }
  scene.meshes.push_back(scene.meshes[0]);
  scene.meshes[2].surface = 1;
  SceneNode lone{
      .name = "pebble-1", .translation = {1, 2, 3}, .rotation = {0.5, 0.5, 0.5, 0.5}, .scale = 3, .mesh = 0};
  SceneNode strewn{.name = "strewn", .mesh = 1};
  strewn.instances = {{{5, 0, 0}, {1, 0, 0, 0}, 1}, {{0, 0, 7}, {0, 0, 1, 0}, 2}, {{-4, 0, 0}, {1, 0, 0, 0}, 0.5}};
  SceneNode hull{.name = "hull", .mesh = 2, .hull = true};
  SceneNode hidden{.name = "hidden", .mesh = 2};
  scene.nodes = {lone, strewn, hull, hidden};
  scene.views = {{"all", {0, 1, 2, 3}}, {"few", {0}}};
  return scene;
}

void expect_near(const glm::dmat4& a, const glm::dmat4& b, double tolerance) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) EXPECT_NEAR(a[c][r], b[c][r], tolerance);
}

TEST(ReadGltf, reads_what_is_written) {
  const Scene scene = example(false);
  for (const std::string& file : {write_glb(scene), write_gltf(scene)}) {
    ASSERT_TRUE(looks_like_gltf(file));
    const auto read = read_gltf(file);
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->meshes.size(), 3U);
    for (std::size_t m = 0; m < 3; ++m) {
      EXPECT_EQ(read->meshes[m].positions, scene.meshes[m].positions);
      EXPECT_EQ(read->meshes[m].texture_coordinates, scene.meshes[m].texture_coordinates);
      EXPECT_EQ(read->meshes[m].colours, scene.meshes[m].colours);
      EXPECT_EQ(*read->meshes[m].indices, *scene.meshes[m].indices);
      EXPECT_EQ(read->meshes[m].surface, scene.meshes[m].surface);
      for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(glm::length(read->meshes[m].normals[i] - scene.meshes[m].normals[i]), 0, 1e-6);
    }
    ASSERT_EQ(read->surfaces.size(), 2U);
    EXPECT_EQ(read->surfaces[0].colour, 0);
    EXPECT_TRUE(read->surfaces[0].visible);
    EXPECT_FALSE(read->surfaces[1].visible);
    ASSERT_EQ(read->textures.size(), 1U);
    EXPECT_EQ(read->textures[0].width, 32);
    EXPECT_EQ(read->textures[0].height, 16);
    EXPECT_TRUE(read->textures[0].mirrored);
    EXPECT_NEAR(read->textures[0].rgb[0], 140, 2);  // JPEG
    ASSERT_EQ(read->views.size(), 2U);
    EXPECT_EQ(read->views[0].nodes, scene.views[0].nodes);
    EXPECT_EQ(read->nodes[2].hull, true);
  }
}

TEST(ReadGltf, quantized_or_not_things_are_where_they_were) {
  const Scene scene = example(true);
  const auto read = read_gltf(write_glb(scene));
  ASSERT_TRUE(read) << read.error().message;
  const auto expected = placed_meshes(scene), placed = placed_meshes(*read);
  ASSERT_EQ(placed.size(), 4U);  // a lone one and three strewn
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t v = 0; v < 4; ++v) {
      const auto at = [&](const Scene& s, const PlacedMesh& p) {
        return glm::dvec3(p.place * glm::dvec4(s.meshes[static_cast<std::size_t>(p.mesh)].positions[v], 1));
      };
      EXPECT_NEAR(glm::length(at(*read, placed[i]) - at(scene, expected[i])), 0, 1e-3);
    }
}

TEST(PlacedMeshes, are_scaled_then_turned_then_moved) {
  const Scene scene = example(false);
  const auto placed = placed_meshes(scene);
  ASSERT_EQ(placed.size(), 4U);
  // (w, x, y, z) = 1/2 each turns x to y, y to z and z to x.
  expect_near(placed[0].place, glm::dmat4{{0, 3, 0, 0}, {0, 0, 3, 0}, {3, 0, 0, 0}, {1, 2, 3, 1}}, 1e-12);
  expect_near(placed[3].place, glm::dmat4{{.5, 0, 0, 0}, {0, .5, 0, 0}, {0, 0, .5, 0}, {-4, 0, 0, 1}}, 1e-12);
  const Bounds box = bounds_of(scene, {placed[3]});
  EXPECT_NEAR(glm::length(box.least - glm::dvec3(-5, -1, -1)), 0, 1e-12);
  EXPECT_NEAR(glm::length(box.most - glm::dvec3(-3, 1, 1)), 0, 1e-12);
  EXPECT_EQ(bounds_of(scene, {}).most, glm::dvec3(0));
}

TEST(ReadGltf, refuses_what_is_no_glTF) {
  EXPECT_FALSE(looks_like_gltf(""));
  EXPECT_FALSE(looks_like_gltf("{\"schemaVersion\": 1}"));
  EXPECT_FALSE(looks_like_gltf("\x89PNG"));
  for (const char* text : {"glTF", "{\"asset\": 1", "{\"asset\": {\"version\": \"2.0\"}}",
                           R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[7]}]})",
                           R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"children":[0]}]})"}) {
    const auto read = read_gltf(text);
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().code, StatusCode::kInvalidInput);
    EXPECT_EQ(read.error().message.find('\n'), std::string::npos);
  }
}

// Whatever a byte is changed to: a scene whose indices are within their lists, or a reason.
TEST(ReadGltf, damaged_files_do_no_harm) {
  const std::string file = write_glb(example(false));
  std::mt19937 random(5);
  int read_well = 0, refused = 0;
  for (int k = 0; k < 600; ++k) {
    std::string damaged = file;
    for (int n = 0; n < 1 + k % 3; ++n) damaged[20 + random() % (file.size() - 20)] = static_cast<char>(random());
    if (k % 10 == 0) damaged.resize(random() % file.size());
    const auto read = read_gltf(damaged);
    if (!read) {
      ++refused;
      continue;
    }
    ++read_well;
    for (const Mesh& mesh : read->meshes)
      for (const std::uint32_t index : *mesh.indices) ASSERT_LT(index, mesh.positions.size());
    bounds_of(*read, placed_meshes(*read));
  }
  EXPECT_GT(read_well, 0);
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace tessera::view
