// Draws a scene with OpenGL ES 3.0.
#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "tessera/base/status.h"
#include "tessera/gpu/gl_object.h"
#include "tessera/view/orbit_camera.h"
#include "tessera/view/placed_mesh.h"

namespace tessera::view {

// Lives and dies with its context current.
class SolidPainter {
 public:
  static Result<SolidPainter> create();

  // Puts on the card what the scene's first view shows; the scene itself is not kept.
  void show(const Scene& scene, const std::vector<PlacedMesh>& placed);
  void draw(const OrbitCamera& camera);

 private:
  // Triangles of a mesh, as a part of the indices.
  struct Range {
    std::size_t first = 0, count = 0;
    std::size_t colours = 0, bumps = 0;  // textures
  };
  struct Instance {
    std::size_t mesh;
    glm::mat4 place;
  };
  explicit SolidPainter(gl::Program program) : program_(std::move(program)) {}
  void upload_meshes(const Scene& scene);
  void upload_textures(const Scene& scene);

  gl::Program program_;
  gl::VertexArray layout_;
  gl::Buffer vertices_, indices_;
  std::vector<Range> meshes_;
  std::vector<Instance> instances_;    // by textures
  std::vector<gl::Texture> textures_;  // the last two are white, and without bumps
};

}  // namespace tessera::view
