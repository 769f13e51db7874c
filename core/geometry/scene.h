// A 3D scene before it is a file: what techniques hand to the writers of 3D formats. Y up, right-handed, metres;
// triangles are counter-clockwise from outside.
#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tessera/geometry/mesh.h"

namespace tessera {

// 8 bits a channel, R G B interleaved, rows from the top.
struct Texture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  // 3 * width * height
  bool mirrored = false;          // what lies beyond the sides: the picture mirrored, or the side's own colour
};

// How a mesh looks. Textures are indices into Scene::textures, -1: none.
struct Surface {
  std::string name;
  double roughness = 1, metallic = 0;  // 0..1
  int colour = -1;                     // texture of base colours
  int normals = -1;                    // texture of normals in tangent space, green up
  bool visible = true;                 // false: for a physics engine only
};

// A thing in the scene: scaled, turned, moved, in this order. Things do not hang on one another.
struct SceneNode {
  // A copy of the node's mesh with a place of its own, in the node's frame.
  struct Instance {
    glm::dvec3 translation{0};
    glm::dquat rotation{1, 0, 0, 0};
    double scale = 1;
  };
  using Extra = std::variant<double, std::vector<double>>;

  std::string name;
  glm::dvec3 translation{0};
  glm::dquat rotation{1, 0, 0, 0};
  double scale = 1;                                     // > 0
  int mesh = -1;                                        // index into Scene::meshes
  bool hull = false;                                    // its mesh is the convex shape of a body at rest
  std::vector<Instance> instances{};                    // empty: the mesh itself, once
  std::vector<std::pair<std::string, Extra>> extras{};  // what else is known of it, finite
};

struct Scene {
  // One of several selections of the nodes, the first is the one to show.
  struct View {
    std::string name;
    std::vector<int> nodes;
  };

  std::vector<Texture> textures;
  std::vector<Surface> surfaces;
  std::vector<Mesh> meshes;
  std::vector<SceneNode> nodes;
  std::vector<View> views;
  bool quantize = false;  // whole numbers for meshes where the format has them
  std::string job_json;   // the job that made it, one JSON object; empty: none
};

}  // namespace tessera
