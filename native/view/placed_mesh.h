// A scene as what is drawn: meshes and where they are.
#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "tessera/geometry/scene.h"
#include "tessera/view/orbit_camera.h"

namespace tessera::view {

struct PlacedMesh {
  int mesh;          // index into Scene::meshes
  glm::dmat4 place;  // from the mesh's frame to the world
};

// What the scene's first view shows, instances one by one; without what is there for a physics engine only.
std::vector<PlacedMesh> placed_meshes(const Scene& scene);

// The box around all of it; of no size at the origin where there is nothing.
Bounds bounds_of(const Scene& scene, const std::vector<PlacedMesh>& placed);

}  // namespace tessera::view
