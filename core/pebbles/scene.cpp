#include "tessera/pebbles/scene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <string>

#include "tessera/pebbles/mesh.h"
#include "tessera/pebbles/scatter.h"
#include "tessera/pebbles/texture.h"

namespace tessera::pebbles {
namespace {

constexpr double kOffCentre = 0.2;  // of a pebble's radius: how far its outline's centre may be off that of volume
constexpr double kBumps = 0.2;      // of h, a tenth of the whole height: relief of 1
constexpr double kNormalMapRelief = 0.5;             // what the normal map shows
constexpr double kLeastBump = 1.0 / 12;              // of its radius: finer shading is grain
constexpr double kMostBump = 1.0 / 2;                // coarser shading is its own roundness
constexpr const char* kHullSuffix = "-convcolonly";  // as some engines want it

// ---- The photo in the world

class World {
 public:
  World(const ImageView& photo, const Params& params)
      : middle_{photo.width / 2.0, photo.height / 2.0}, metres_(metres_per_pixel(params, photo.width)) {
    for (double step = metres_ / 1000; step < 1 && digits_ < 1e15; step *= 10) digits_ *= 10;
  }

  double metres() const { return metres_; }  // a pixel
  glm::dvec3 place(Point pixel, double up) const {
    return {exact((pixel.x - middle_.x) * metres_), exact(up * metres_), exact((pixel.y - middle_.y) * metres_)};
  }
  // Rounded to less than a thousandth of a pixel: a short number in a text.
  double exact(double metres) const { return std::round(metres * digits_) / digits_; }

 private:
  Point middle_;
  double metres_;
  double digits_ = 1;  // steps to a metre
};

double rounded(double v) { return std::round(v * 100) / 100; }

// ---- One pebble

struct Stone {
  int id = 0;
  Mesh mesh, hull;    // metres, around the centre of volume
  Point pixel;        // where that is in the photo
  double up = 0;      // its height above the ground where the lowest point rests on it, px
  double radius = 0;  // of a circle around it that holds the mesh, metres
  std::vector<std::pair<std::string, SceneNode::Extra>> extras;
};

double largest(const std::vector<double>& radii) { return *std::max_element(radii.begin(), radii.end()); }

double area_of(const std::vector<double>& radii) { return signed_area(outline({0, {0, 0}, radii, 0})); }

// r(phi) at a mesh's meridians, so that the polygon has the outline's area: half of what the chords cut off is given
// back, and levels of detail do not shrink.
std::vector<double> meridians_of(const Pebble& pebble, int count) {
  std::vector<double> radii = resampled(pebble.radii, count);
  const double grow = std::sqrt(area_of(pebble.radii) / area_of(radii));
  for (double& r : radii) r *= grow;
  return radii;
}

// A point on the axis halfway up: all of the surface is seen from there.
glm::dvec3 heart_of(const Mesh& mesh) { return {0, 0.5 * (mesh.positions.front().y + mesh.positions.back().y), 0}; }

// Vertices of the upper half moved as the photo's shading says, less and less towards the rim. By as much as stands
// out along the normal, but towards or away from the heart: nothing folds over.
void raise(Mesh& mesh, const Shading& shading, Point centre, const Bumps& bumps) {
  const glm::dvec3 heart = heart_of(mesh);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const glm::dvec3 normal(mesh.normals[v]);
    if (normal.y <= 0) continue;
    glm::vec3& position = mesh.positions[v];
    const double height = normal.y * bumps.at(centre + Point{position.x, position.z}, shading);
    position += glm::vec3(height * glm::normalize(glm::dvec3(position) - heart));
  }
  average_normals(mesh);
}

// The centre of volume; in the photo no farther from the outline's centre than need be.
glm::dvec3 pivot_of(const Mesh& mesh, double radius) {
  glm::dvec3 pivot = measure(mesh).centre;
  const double away = std::sqrt(pivot.x * pivot.x + pivot.z * pivot.z);
  const double keep = away > 0 ? std::max(0.0, 1 - kOffCentre * radius / away) : 0;
  pivot.x *= keep;
  pivot.z *= keep;
  return pivot;
}

void move_and_scale(Mesh& mesh, const glm::dvec3& origin, double scale) {
  for (glm::vec3& position : mesh.positions) position = glm::vec3((glm::dvec3(position) - origin) * scale);
}

// Of what a mesh of so many meridians can show, 0: of all that the photo does.
Bumps bumps_of(const Pebble& pebble, const Params& params, double relief, int meridians) {
  const double radius = std::sqrt(area_of(pebble.radii) / kPi);
  const double least = std::max(1.0, radius * std::max(kLeastBump, meridians > 0 ? kPi / meridians : 0));
  return {least, std::max(2 * least, kMostBump * radius),
          relief * kBumps * params.height_factor * half_height(pebble.radii, params.height)};
}

// Each list of triangles once.
class TriangleLists {
 public:
  Indices add(Detail detail) {
    Indices& list = lists_[{detail.meridians, detail.parallels}];
    if (!list) list = std::make_shared<const std::vector<std::uint32_t>>(body_triangles(detail));
    return list;
  }
  Indices of(Detail detail) const { return lists_.at({detail.meridians, detail.parallels}); }

 private:
  std::map<std::pair<int, int>, Indices> lists_;
};

Stone make_stone(const Pebble& pebble, const World& world, const Params& params, const Shading* shading,
                 cv::Size photo, const TriangleLists& triangles) {
  const double farthest = largest(pebble.radii), error = params.mesh_error;
  const Detail detail = detail_of(farthest, error, params.lod);
  const Body body{meridians_of(pebble, detail.meridians),
                  params.height_factor * half_height(pebble.radii, params.height), params.flatten};
  Stone stone;
  stone.id = pebble.id;
  stone.mesh = body_mesh(body, detail.parallels);
  stone.mesh.indices = triangles.of(detail);
  if (params.relief > 0)
    raise(stone.mesh, *shading, pebble.centre, bumps_of(pebble, params, params.relief, detail.meridians));
  mend_normals(stone.mesh, heart_of(stone.mesh));
  project_texture(stone.mesh, pebble.centre, body.radii, photo);
  if (params.normal_map) add_tangents(stone.mesh);
  if (params.collider == Collider::kHull) stone.hull = body_hull(body);

  const glm::dvec3 pivot = pivot_of(stone.mesh, std::sqrt(area_of(body.radii) / kPi));
  float lowest = 0;
  for (const glm::vec3& position : stone.mesh.positions) lowest = std::min(lowest, position.y);
  stone.pixel = pebble.centre + Point{pivot.x, pivot.z};
  stone.up = pivot.y - lowest;
  stone.radius = largest(body.radii) * world.metres();
  move_and_scale(stone.mesh, pivot, world.metres());
  move_and_scale(stone.hull, pivot, world.metres());

  std::vector<double> radii = meridians_of(pebble, detail_of(farthest, error, 0).meridians);
  for (double& r : radii) r = rounded(r);
  stone.extras = {{"area_px", rounded(pebble.area_px)},
                  {"centre_px", std::vector<double>{rounded(stone.pixel.x), rounded(stone.pixel.y)}},
                  {"radii", std::move(radii)}};
  return stone;
}

std::vector<Stone> make_stones(const std::vector<Pebble>& pebbles, const World& world, const Params& params,
                               const Shading* shading, cv::Size photo) {
  std::vector<Stone> stones(pebbles.size());
  TriangleLists triangles;
  for (const Pebble& pebble : pebbles) triangles.add(detail_of(largest(pebble.radii), params.mesh_error, params.lod));
  cv::parallel_for_({0, static_cast<int>(pebbles.size())}, [&](const cv::Range& range) {
    for (int k = range.start; k < range.end; ++k) {
      const auto i = static_cast<std::size_t>(k);
      stones[i] = make_stone(pebbles[i], world, params, shading, photo, triangles);
    }
  });
  if (params.collider == Collider::kHull)
    for (Stone& stone : stones) stone.hull.indices = triangles.add(hull_detail(stone.hull));
  return stones;
}

// ---- The scene

class Field {
 public:
  Field(const World& world, const Params& params, const ImageView& photo)
      : world_(world),
        params_(params),
        photo_(photo),
        size_{world.metres() * photo.width, world.metres() * photo.height} {}

  void add_surfaces(const std::vector<Pebble>& pebbles, const cv::Mat1i& labels, Texture texture,
                    const Shading* shading) {
    scene_.textures.push_back(std::move(texture));
    scene_.surfaces.push_back({"pebbles", params_.roughness, 0, 0, -1, true});
    if (params_.normal_map) {
      std::vector<Bumps> bumps(1);
      for (const Pebble& pebble : pebbles) {
        bumps.resize(std::max(bumps.size(), static_cast<std::size_t>(pebble.id) + 1));
        bumps[static_cast<std::size_t>(pebble.id)] = bumps_of(pebble, params_, kNormalMapRelief, 0);
      }
      scene_.surfaces[0].normals = static_cast<int>(scene_.textures.size());
      scene_.textures.push_back(normals_texture(*shading, labels, bumps));
    }
    if (params_.ground) {
      Texture ground = params_.ground_hole ? ground_texture(photo_, labels) : photo_texture(photo_);
      ground.mirrored = params_.scatter > 0;
      ground_surface_ = add_surface({"ground", 1, 0, static_cast<int>(scene_.textures.size()), -1, true});
      scene_.textures.push_back(std::move(ground));
    }
    if (params_.collider == Collider::kHull) hull_surface_ = add_surface({"collider", 1, 0, -1, -1, false});
  }

  // One node a pebble, each where it lies in the photo.
  void add_nodes(std::vector<Stone>& stones, std::vector<int>& view) {
    for (Stone& stone : stones) {
      SceneNode node = node_of(stone, stone.mesh, 0);
      node.extras = std::move(stone.extras);
      view.push_back(add(std::move(node)));
    }
  }

  // All pebbles as one mesh.
  void add_merged(const std::vector<Stone>& stones, std::vector<int>& view) {
    Mesh all;
    std::vector<std::uint32_t> indices;
    for (const Stone& stone : stones) append(stone.mesh, world_.place(stone.pixel, stone.up), all, indices);
    if (all.positions.empty()) return;
    all.indices = std::make_shared<const std::vector<std::uint32_t>>(std::move(indices));
    all.surface = 0;
    view.push_back(add({.name = "pebbles", .mesh = add_mesh(std::move(all))}));
  }

  std::vector<int> add_hulls(std::vector<Stone>& stones) {
    std::vector<int> nodes;
    if (hull_surface_ < 0) return nodes;
    for (Stone& stone : stones) {
      SceneNode node = node_of(stone, stone.hull, hull_surface_);
      node.name += kHullSuffix;
      node.hull = true;
      nodes.push_back(add(std::move(node)));
    }
    return nodes;
  }

  // Instances of a few pebbles, strewn at random.
  void add_strewn(std::vector<Stone>& stones, std::uint64_t seed, std::vector<int>& view) {
    std::vector<double> radii;
    for (const Stone& stone : stones) radii.push_back(stone.radius);
    const Strewn strewn = strew(radii, params_.scatter, size_, params_.strewing, seed);
    size_ = strewn.size;
    std::vector<std::vector<SceneNode::Instance>> instances(stones.size());
    for (const Throw& t : strewn.throws) {
      const double up = stones[t.stone].up * world_.metres() * t.scale;
      const SinCos half = sin_cos(t.turn / 2);
      instances[t.stone].push_back({{t.place.x, up, t.place.y}, {half.cos, 0, half.sin, 0}, t.scale});
    }
    for (std::size_t i = 0; i < stones.size(); ++i) {
      if (instances[i].empty()) continue;
      SceneNode node = node_of(stones[i], stones[i].mesh, 0);
      node.translation = glm::dvec3(0);
      node.extras = std::move(stones[i].extras);
      node.instances = instances[i];
      if (params_.instancing) {
        view.push_back(add(std::move(node)));
      } else {
        add_places(node, "", view);
      }
      if (hull_surface_ < 0) continue;
      SceneNode hull = node_of(stones[i], stones[i].hull, hull_surface_);
      hull.hull = true;
      hull.instances = std::move(instances[i]);
      add_places(hull, kHullSuffix, view);
    }
  }

  std::vector<int> add_ground() {
    if (ground_surface_ < 0) return {};
    const Point half = 0.5 * size_;
    const double u = half.x / (world_.metres() * photo_.width), v = half.y / (world_.metres() * photo_.height);
    Mesh plane;
    for (const auto& [x, z] : {std::pair(-1, -1), {-1, 1}, {1, 1}, {1, -1}}) {
      plane.positions.emplace_back(x * half.x, 0, z * half.y);
      plane.normals.emplace_back(0, 1, 0);
      plane.texture_coordinates.emplace_back(0.5 + x * u, 0.5 + z * v);
    }
    plane.indices = std::make_shared<const std::vector<std::uint32_t>>(std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
    plane.surface = ground_surface_;
    return {add({.name = "ground", .mesh = add_mesh(std::move(plane))})};
  }

  Scene scene() { return std::move(scene_); }

 private:
  int add_surface(Surface surface) {
    scene_.surfaces.push_back(std::move(surface));
    return static_cast<int>(scene_.surfaces.size()) - 1;
  }
  int add_mesh(Mesh mesh) {
    scene_.meshes.push_back(std::move(mesh));
    return static_cast<int>(scene_.meshes.size()) - 1;
  }
  int add(SceneNode node) {
    scene_.nodes.push_back(std::move(node));
    return static_cast<int>(scene_.nodes.size()) - 1;
  }

  // A node for each of a node's instances, all of one mesh: some programs know no instances, and engines make bodies
  // of nodes.
  void add_places(const SceneNode& node, const char* suffix, std::vector<int>& view) {
    for (std::size_t k = 0; k < node.instances.size(); ++k)
      view.push_back(add({.name = node.name + "-" + std::to_string(k + 1) + suffix,
                          .translation = node.instances[k].translation,
                          .rotation = node.instances[k].rotation,
                          .scale = node.instances[k].scale,
                          .mesh = node.mesh,
                          .hull = node.hull,
                          .extras = node.extras}));
  }

  SceneNode node_of(const Stone& stone, Mesh& mesh, int surface) {
    mesh.surface = surface;
    return {.name = "pebble-" + std::to_string(stone.id),
            .translation = world_.place(stone.pixel, stone.up),
            .mesh = add_mesh(std::move(mesh))};
  }

  static void append(const Mesh& mesh, const glm::dvec3& place, Mesh& all, std::vector<std::uint32_t>& indices) {
    const auto first = static_cast<std::uint32_t>(all.positions.size());
    for (const glm::vec3& position : mesh.positions) all.positions.emplace_back(glm::dvec3(position) + place);
    const auto join = [](auto& target, const auto& source) {
      target.insert(target.end(), source.begin(), source.end());
    };
    join(all.normals, mesh.normals);
    join(all.texture_coordinates, mesh.texture_coordinates);
    join(all.tangents, mesh.tangents);
    for (const std::uint32_t index : *mesh.indices) indices.push_back(first + index);
  }

  const World& world_;
  const Params& params_;
  const ImageView& photo_;
  Point size_;  // metres
  Scene scene_;
  int ground_surface_ = -1, hull_surface_ = -1;
};

}  // namespace

Scene build_scene(const std::vector<Pebble>& pebbles, const cv::Mat1i& labels, const ImageView& photo,
                  const Params& params, std::uint64_t seed) {
  const World world(photo, params);
  Texture texture = pebbles_texture(photo, labels);
  const bool needs_shading = params.relief > 0 || params.normal_map;
  const Shading shading = needs_shading ? Shading(texture) : Shading();

  const bool strewn = params.scatter > 0;
  std::vector<Stone> stones = make_stones(strewn ? prototypes(pebbles, params.prototypes, seed) : pebbles, world,
                                          params, &shading, {photo.width, photo.height});
  Field field(world, params, photo);
  field.add_surfaces(pebbles, labels, std::move(texture), &shading);

  std::vector<Scene::View> views;
  std::vector<int> shared;  // by all views
  if (strewn) {
    field.add_strewn(stones, seed, views.emplace_back(Scene::View{"pebbles", {}}).nodes);
  } else {
    shared = field.add_hulls(stones);
    Scene::View merged{"merged", {}};
    if (params.layout != FieldLayout::kNodes) field.add_merged(stones, merged.nodes);
    if (params.layout != FieldLayout::kMerged)
      field.add_nodes(stones, views.emplace_back(Scene::View{"pebbles", {}}).nodes);
    if (params.layout != FieldLayout::kNodes) views.push_back(std::move(merged));
  }
  const std::vector<int> ground = field.add_ground();
  shared.insert(shared.end(), ground.begin(), ground.end());
  for (Scene::View& view : views) view.nodes.insert(view.nodes.end(), shared.begin(), shared.end());

  Scene scene = field.scene();
  scene.views = std::move(views);
  scene.quantize = params.quantize;
  return scene;
}

}  // namespace tessera::pebbles
