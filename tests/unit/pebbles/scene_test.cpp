#include "tessera/pebbles/scene.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <string>

#include "stones.h"
#include "tessera/formats/formats.h"
#include "tessera/pebbles/mesh.h"
#include "tessera/pebbles/scatter.h"
#include "tessera/pebbles/texture.h"

namespace tessera::pebbles {
namespace {

using testing::SizeIs;

// Ellipses on a grid, each of a colour of its own, on dark ground.
struct Beach {
  cv::Mat3b pixels = cv::Mat3b(200, 300, cv::Vec3b(20, 15, 10));
  cv::Mat1i labels = cv::Mat1i(200, 300, 0);
  std::vector<Pebble> pebbles;

  Beach() {
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 6; ++column) add({25.0 + 50 * column, 25.0 + 50 * row}, 21 - row, 19 - column);
  }
  void add(Point centre, double a, double b) {
    const int id = static_cast<int>(pebbles.size()) + 1;
    Pebble pebble{id, centre, ellipse(a, b, 64), 0};
    for (int y = 0; y < labels.rows; ++y)
      for (int x = 0; x < labels.cols; ++x) {
        const double u = (x + 0.5 - centre.x) / a, v = (y + 0.5 - centre.y) / b;
        if (u * u + v * v > 1) continue;
        labels(y, x) = id;
        pixels(y, x) = {static_cast<std::uint8_t>(100 + 5 * id),
                        static_cast<std::uint8_t>(120 + (x * 7 + y * 5) % 40), 90};
        pebble.area_px += 1;
      }
    pebbles.push_back(pebble);
  }
  ImageView photo() const {
    return {pixels.data, pixels.cols, pixels.rows, static_cast<std::ptrdiff_t>(pixels.step)};
  }
  Scene scene(const Params& params, std::uint64_t seed = 1) const {
    return build_scene(pebbles, labels, photo(), params, seed);
  }
};

const SceneNode::Extra& extra(const SceneNode& node, const std::string& key) {
  const auto found =
      std::find_if(node.extras.begin(), node.extras.end(), [&](const auto& e) { return e.first == key; });
  EXPECT_NE(found, node.extras.end()) << key;
  return found->second;
}

const Mesh& mesh_of(const Scene& scene, const SceneNode& node) {
  return scene.meshes[static_cast<std::size_t>(node.mesh)];
}

float lowest(const Mesh& mesh) {
  return std::min_element(mesh.positions.begin(), mesh.positions.end(), [](auto a, auto b) { return a.y < b.y; })->y;
}

TEST(BuildScene, ANodeAPebbleThatRestsOnTheGroundAroundItsCentreOfVolume) {
  const Beach beach;
  for (const double flatten : {0.0, 0.6, 1.0}) {
    Params params;
    params.flatten = flatten;
    params.width_m = 6;
    const Scene scene = beach.scene(params);
    ASSERT_THAT(scene.views, SizeIs(1));
    ASSERT_THAT(scene.views[0].nodes, SizeIs(24));
    for (std::size_t i = 0; i < 24; ++i) {
      const SceneNode& node = scene.nodes[static_cast<std::size_t>(scene.views[0].nodes[i])];
      const Mesh& mesh = mesh_of(scene, node);
      EXPECT_EQ(node.name, "pebble-" + std::to_string(i + 1));
      EXPECT_NEAR(node.translation.x, (beach.pebbles[i].centre.x - 150) * 0.02, 1e-4);
      EXPECT_NEAR(node.translation.z, (beach.pebbles[i].centre.y - 100) * 0.02, 1e-4);
      EXPECT_NEAR(node.translation.y + lowest(mesh), 0, 1e-4);
      const Solid solid = measure(mesh);
      EXPECT_GT(solid.volume, 0);
      EXPECT_LT(glm::length(solid.centre), 0.01 * 0.02 * 20);
      EXPECT_EQ(std::get<double>(extra(node, "area_px")), beach.pebbles[i].area_px);
      EXPECT_THAT(std::get<std::vector<double>>(extra(node, "centre_px")), SizeIs(2));
      EXPECT_GE(std::get<std::vector<double>>(extra(node, "radii")).size(), 8U);
    }
  }
}

TEST(BuildScene, SeenFromAboveAPebbleHasItsOutlinesAreaAtEachLevelOfDetail) {
  const Beach beach;
  for (int lod = 0; lod <= 3; ++lod) {
    Params params;
    params.lod = lod;
    params.pixels_per_m = 1;
    const Scene scene = beach.scene(params);
    for (std::size_t i = 0; i < 24; ++i) {
      const Mesh& mesh = mesh_of(scene, scene.nodes[i]);
      double area = 0;
      for (std::size_t t = 0; t < mesh.indices->size(); t += 3) {
        const auto at = [&](std::size_t k) { return mesh.positions[(*mesh.indices)[t + k]]; };
        area += std::max(0.0f, glm::cross(at(1) - at(0), at(2) - at(0)).y / 2);
      }
      EXPECT_NEAR(area / signed_area(outline(beach.pebbles[i])), 1, 1e-4);
    }
  }
}

TEST(BuildScene, TextureCoordinatesAreThePlacesInThePhotoButForTheRim) {
  const Beach beach;
  Params params;
  params.pixels_per_m = 1;
  const Scene scene = beach.scene(params);
  for (const SceneNode& node : scene.nodes) {
    const Mesh& mesh = mesh_of(scene, node);
    const std::vector<double>& centre = std::get<std::vector<double>>(extra(node, "centre_px"));
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      const Point real{centre[0] + mesh.positions[v].x, centre[1] + mesh.positions[v].z};
      const Point shown{mesh.texture_coordinates[v].x * 300.0, mesh.texture_coordinates[v].y * 200.0};
      EXPECT_LT(length(real - shown), 1.1);
      EXPECT_GT(beach.labels(static_cast<int>(shown.y), static_cast<int>(shown.x)), 0);
    }
  }
}

TEST(BuildScene, MergedIsTheSameTrianglesInTheWorld) {
  const Beach beach;
  Params params;
  params.layout = FieldLayout::kBoth;
  const Scene scene = beach.scene(params);
  ASSERT_THAT(scene.views, SizeIs(2));
  ASSERT_THAT(scene.views[1].nodes, SizeIs(1));
  const SceneNode& merged = scene.nodes[static_cast<std::size_t>(scene.views[1].nodes[0])];
  const Mesh& all = mesh_of(scene, merged);
  double volume = 0;
  for (const int node : scene.views[0].nodes)
    volume += measure(mesh_of(scene, scene.nodes[static_cast<std::size_t>(node)])).volume;
  EXPECT_NEAR(measure(all).volume / volume, 1, 1e-4);
  EXPECT_TRUE(is_closed(*all.indices));
  EXPECT_NEAR(lowest(all), 0, 1e-6);
  EXPECT_EQ(all.texture_coordinates.size(), all.positions.size());
}

TEST(BuildScene, OptionsAddWhatTheySay) {
  const Beach beach;
  Params params;
  params.ground = true;
  params.collider = Collider::kHull;
  params.normal_map = true;
  params.relief = 1;
  params.quantize = true;
  const Scene scene = beach.scene(params);
  EXPECT_TRUE(scene.quantize);
  EXPECT_THAT(scene.surfaces, SizeIs(3));
  EXPECT_THAT(scene.textures, SizeIs(3));
  EXPECT_EQ(scene.nodes.back().name, "ground");
  int hulls = 0;
  for (const SceneNode& node : scene.nodes) {
    const Mesh& mesh = mesh_of(scene, node);
    if (!node.hull) continue;
    ++hulls;
    EXPECT_LE(mesh.positions.size(), 32U);
    EXPECT_TRUE(node.name.ends_with("-convcolonly"));
  }
  EXPECT_EQ(hulls, 24);
  const Mesh& pebble = mesh_of(scene, scene.nodes[30]);
  EXPECT_EQ(pebble.tangents.size(), pebble.positions.size());
  for (std::size_t v = 0; v < pebble.tangents.size(); ++v) {
    EXPECT_NEAR(glm::length(glm::vec3(pebble.tangents[v])), 1, 1e-5);
    EXPECT_NEAR(glm::dot(glm::vec3(pebble.tangents[v]), pebble.normals[v]), 0, 1e-4);
  }
}

TEST(BuildScene, ReliefMovesVerticesAndKeepsTheMeshSound) {
  const Beach beach;
  Params params;
  const Scene smooth = beach.scene(params);
  params.relief = 1;
  const Scene rough = beach.scene(params);
  EXPECT_NE(smooth.meshes[0].positions, rough.meshes[0].positions);
  for (const Mesh& mesh : rough.meshes) {
    EXPECT_TRUE(is_closed(*mesh.indices));
    EXPECT_GT(measure(mesh).volume, 0);
    for (const glm::vec3& normal : mesh.normals) EXPECT_NEAR(glm::length(normal), 1, 1e-5);
  }
}

TEST(BuildScene, IsTheSameForAnyNumberOfThreads) {
  const Beach beach;
  Params params;
  params.relief = 0.5;
  params.normal_map = true;
  params.ground = params.ground_hole = true;
  const int before = cv::getNumThreads();
  cv::setNumThreads(1);
  const std::string one = write_glb(beach.scene(params));
  cv::setNumThreads(2);
  const std::string two = write_glb(beach.scene(params));
  cv::setNumThreads(before);
  EXPECT_EQ(one, two);
}

// FNV-1a of the bytes.
std::uint64_t hash_of(const std::string& bytes) {
  std::uint64_t hash = 14695981039346656037U;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  return hash;
}

TEST(BuildScene, IsTheSameOnEveryMachine) {
  const Beach beach;
  Params params;
  params.relief = 0.5;
  params.flatten = 0.3;
  params.normal_map = params.ground = params.ground_hole = true;
  params.collider = Collider::kHull;
  params.layout = FieldLayout::kBoth;
  EXPECT_EQ(hash_of(write_glb(beach.scene(params))), 10047847919629442846U);
}

TEST(BuildScene, NothingOfNothing) {
  const cv::Mat3b pixels(4, 5, cv::Vec3b(1, 2, 3));
  for (const FieldLayout layout : {FieldLayout::kNodes, FieldLayout::kMerged, FieldLayout::kBoth})
    for (const int scatter : {0, 10}) {
      Params params;
      params.layout = layout;
      params.scatter = scatter;
      params.collider = Collider::kHull;
      const Scene scene = build_scene({}, cv::Mat1i::zeros(4, 5), {pixels.data, 5, 4, 15}, params, 1);
      EXPECT_TRUE(scene.nodes.empty());
      EXPECT_FALSE(scene.views.empty());
    }
}

constexpr Strewing kStrewings[] = {Strewing::kBlueNoise, Strewing::kInhibition, Strewing::kCluster,
                                   Strewing::kPoisson};

// Around the field, as if it went on at its other side.
double distance_around(Point a, Point b, Point size) {
  const Point d = a - b;
  return length({d.x - size.x * std::round(d.x / size.x), d.y - size.y * std::round(d.y / size.y)});
}

TEST(Scatter, PutsAsManyAsAskedForApart) {
  const std::vector<double> radii = {0.02, 0.05, 0.03};
  for (const Strewing strewing : kStrewings)
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const Strewn strewn = strew(radii, 500, {1, 0.7}, strewing, seed);
      ASSERT_THAT(strewn.throws, SizeIs(500));
      EXPECT_GE(strewn.size.x, 1);
      EXPECT_NEAR(strewn.size.y / strewn.size.x, 0.7, 1e-9);
      for (std::size_t a = 0; a < 500; ++a) {
        const Throw& s = strewn.throws[a];
        EXPECT_LE(std::fabs(s.place.x), strewn.size.x / 2);
        EXPECT_LE(std::fabs(s.place.y), strewn.size.y / 2);
        for (std::size_t b = a + 1; b < 500; ++b) {
          const Throw& t = strewn.throws[b];
          EXPECT_GE(distance_around(s.place, t.place, strewn.size) + 1e-12,
                    radii[s.stone] * s.scale + radii[t.stone] * t.scale);
        }
      }
    }
}

TEST(Scatter, FindsAFieldForFewAndForUnequal) {
  for (const Strewing strewing : kStrewings)
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      EXPECT_THAT(strew({0.5}, 1, {0.1, 0.1}, strewing, seed).throws, SizeIs(1));
      EXPECT_THAT(strew({0.001, 1}, 40, {10, 0.1}, strewing, seed).throws, SizeIs(40));
      EXPECT_THAT(strew({}, 40, {1, 1}, strewing, seed).throws, SizeIs(0));
    }
}

// Of counts in a grid of squares, variance against mean: 1 for a Poisson process, less where points keep away.
double clumping(const Strewn& strewn) {
  constexpr int kSquares = 8;
  std::vector<double> counts(kSquares * kSquares, 0);
  const auto square = [](double v, double size) {
    return std::clamp(static_cast<int>((v / size + 0.5) * kSquares), 0, kSquares - 1);
  };
  for (const Throw& t : strewn.throws)
    ++counts[static_cast<std::size_t>(square(t.place.y, strewn.size.y) * kSquares +
                                      square(t.place.x, strewn.size.x))];
  const double mean = static_cast<double>(strewn.throws.size()) / (kSquares * kSquares);
  double squares = 0;
  for (const double count : counts) squares += (count - mean) * (count - mean);
  return squares / (kSquares * kSquares) / mean;
}

TEST(Scatter, LiesEvenlyOrInGroupsAsAsked) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto clumps = [&](Strewing strewing) { return clumping(strew({0.01}, 1000, {1, 1}, strewing, seed)); };
    EXPECT_LT(clumps(Strewing::kBlueNoise), 0.6);
    EXPECT_LT(clumps(Strewing::kInhibition), 0.9);
    EXPECT_GT(clumps(Strewing::kCluster), 1.5);  // of a Poisson process, a deviation of 0.18 about 1
  }
}

TEST(Scatter, WithoutInstancesEachStoneIsANodeOfTheSamePlace) {
  const Beach beach;
  Params params;
  params.scatter = 100;
  params.prototypes = 5;
  const Scene with = beach.scene(params, 2);
  params.instancing = false;
  const Scene without = beach.scene(params, 2);
  EXPECT_EQ(with.nodes.size(), 5U);
  EXPECT_EQ(without.nodes.size(), 100U);
  std::size_t k = 0;
  for (const SceneNode& node : with.nodes)
    for (const SceneNode::Instance& instance : node.instances) {
      const SceneNode& plain = without.nodes[k++];
      EXPECT_TRUE(plain.instances.empty());
      EXPECT_EQ(plain.mesh, node.mesh);
      EXPECT_EQ(plain.translation, instance.translation);
      EXPECT_EQ(plain.rotation, instance.rotation);
      EXPECT_EQ(plain.scale, instance.scale);
    }
  EXPECT_EQ(k, 100U);
}

TEST(Scatter, IsThatOfItsSeed) {
  const Beach beach;
  Params params;
  params.scatter = 100;
  EXPECT_EQ(write_glb(beach.scene(params, 3)), write_glb(beach.scene(params, 3)));
  EXPECT_NE(write_glb(beach.scene(params, 3)), write_glb(beach.scene(params, 4)));
  std::size_t instances = 0;
  for (const SceneNode& node : beach.scene(params, 3).nodes) instances += node.instances.size();
  EXPECT_EQ(instances, 100U);
}

TEST(Scatter, EachStoneHasABodyWhereItLies) {
  const Beach beach;
  Params params;
  params.scatter = 100;
  params.flatten = 0.5;
  params.collider = Collider::kHull;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Scene scene = beach.scene(params, seed);
    std::size_t bodies = 0;
    std::set<std::string> names;
    const SceneNode* strewn = nullptr;
    std::size_t place = 0;
    for (const SceneNode& node : scene.nodes) {
      EXPECT_TRUE(names.insert(node.name).second) << node.name;
      if (!node.instances.empty()) strewn = &node, place = 0;
      if (!node.hull) continue;
      ASSERT_NE(strewn, nullptr);
      ASSERT_LT(place, strewn->instances.size());
      const SceneNode::Instance& instance = strewn->instances[place++];
      EXPECT_EQ(node.name, strewn->name + "-" + std::to_string(place) + "-convcolonly");
      EXPECT_EQ(node.translation, instance.translation);
      EXPECT_EQ(node.rotation, instance.rotation);
      EXPECT_EQ(node.scale, instance.scale);
      // In the stone's own frame, the hull lies within its mesh's bounds.
      const auto reach = [&](int mesh, int axis) {
        float most = 0;
        for (const glm::vec3& p : scene.meshes[static_cast<std::size_t>(mesh)].positions)
          most = std::max(most, std::fabs(p[axis]));
        return most;
      };
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_LE(reach(node.mesh, axis), 1.001F * reach(strewn->mesh, axis)) << node.name;
      ++bodies;
    }
    EXPECT_EQ(bodies, 100U);
    EXPECT_EQ(scene.views[0].nodes.size(), scene.nodes.size());
  }
}

TEST(PebblesTexture, KeepsPebblesAndCoversTheGroundWithTheirColours) {
  const Beach beach;
  const Texture texture = pebbles_texture(beach.photo(), beach.labels);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 300; ++x) {
      const std::uint8_t* pixel = &texture.rgb[3 * static_cast<std::size_t>(300 * y + x)];
      EXPECT_GE(pixel[0], 100);  // none of the ground's
      if (beach.labels(y, x) > 0) {
        EXPECT_EQ(cv::Vec3b(pixel[0], pixel[1], pixel[2]), beach.pixels(y, x));
      }
    }
}

TEST(GroundTexture, HasNothingOfThePebbles) {
  const Beach beach;
  const Texture texture = ground_texture(beach.photo(), beach.labels);
  for (std::size_t k = 0; k < texture.rgb.size(); k += 3) ASSERT_EQ(texture.rgb[k], 20);
}

TEST(NormalsTexture, ABrightRidgeLeansAwayOnBothSides) {
  cv::Mat3b pixels(40, 40, cv::Vec3b(100, 100, 100));
  pixels(cv::Rect(18, 0, 4, 40)) = cv::Vec3b(140, 140, 140);
  const ImageView photo{pixels.data, 40, 40, 120};
  const Texture normals = normals_texture(Shading(photo_texture(photo)), cv::Mat1i(40, 40, 1), {{}, {1, 10, 4}});
  const auto at = [&](int x, int c) {
    return normals.rgb[3 * static_cast<std::size_t>(40 * 20 + x) + static_cast<std::size_t>(c)];
  };
  EXPECT_LT(at(17, 0), 118);  // left of it: faces left
  EXPECT_GT(at(22, 0), 138);
  EXPECT_NEAR(at(20, 1), 128, 1);
  EXPECT_NEAR(at(3, 0), 128, 1);
}

}  // namespace
}  // namespace tessera::pebbles
