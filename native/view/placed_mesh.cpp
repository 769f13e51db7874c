#include "tessera/view/placed_mesh.h"

#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace tessera::view {
namespace {

glm::dmat4 place_of(const glm::dvec3& translation, const glm::dquat& rotation, double scale) {
  return glm::scale(glm::translate(glm::dmat4(1), translation) * glm::mat4_cast(rotation), glm::dvec3(scale));
}

bool is_shown(const Scene& scene, const SceneNode& node) {
  const int surface = scene.meshes[static_cast<std::size_t>(node.mesh)].surface;
  return !node.hull && (surface < 0 || scene.surfaces[static_cast<std::size_t>(surface)].visible);
}

}  // namespace

std::vector<PlacedMesh> placed_meshes(const Scene& scene) {
  std::vector<PlacedMesh> placed;
  if (scene.views.empty()) return placed;
  for (const int index : scene.views.front().nodes) {
    const SceneNode& node = scene.nodes[static_cast<std::size_t>(index)];
    if (!is_shown(scene, node)) continue;
    const glm::dmat4 place = place_of(node.translation, node.rotation, node.scale);
    if (node.instances.empty()) placed.push_back({node.mesh, place});
    for (const SceneNode::Instance& i : node.instances)
      placed.push_back({node.mesh, place * place_of(i.translation, i.rotation, i.scale)});
  }
  return placed;
}

Bounds bounds_of(const Scene& scene, const std::vector<PlacedMesh>& placed) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Bounds bounds{glm::dvec3(kFar), glm::dvec3(-kFar)};
  for (const auto& [mesh, place] : placed)
    for (const glm::vec3& position : scene.meshes[static_cast<std::size_t>(mesh)].positions) {
      const glm::dvec3 p(place * glm::dvec4(position, 1));
      bounds = {glm::min(bounds.least, p), glm::max(bounds.most, p)};
    }
  return bounds.least.x > bounds.most.x ? Bounds{} : bounds;
}

}  // namespace tessera::view
