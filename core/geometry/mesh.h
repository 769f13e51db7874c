// Triangles that share vertices, and meshes that share lists of triangles.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <string>
#include <vector>

#include "tessera/base/colour.h"

namespace tessera {

// A list that many meshes may have in common; it does not change.
using Indices = std::shared_ptr<const std::vector<std::uint32_t>>;

// One list a vertex attribute; lists are as long as `positions`, or empty.
struct Mesh {
  std::string name;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;              // of length 1
  std::vector<glm::vec2> texture_coordinates;  // 0..1 across the texture, v down
  std::vector<glm::vec4> tangents;             // towards growing u, of length 1; w: +-1, the bitangent's sign
  std::vector<Rgb> colours;                    // times those of the surface
  Indices indices;                             // three a triangle, counter-clockwise from outside
  int surface = -1;                            // index into Scene::surfaces
};

}  // namespace tessera
