#include "tessera/view/solid_painter.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/gtc/type_ptr.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>

#include "shaders.h"
#include "tessera/view/texture.h"

namespace tessera::view {
namespace {

struct Vertex {
  glm::vec3 position, normal;
  glm::vec2 texture_coordinate;
  std::uint8_t colour[4];
};

void describe_vertices() {
  const auto attribute = [](GLuint location, GLint size, GLenum type, GLboolean normalized, std::size_t offset) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, size, type, normalized, sizeof(Vertex), reinterpret_cast<const void*>(offset));
  };
  attribute(0, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, position));
  attribute(1, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, normal));
  attribute(2, 2, GL_FLOAT, GL_FALSE, offsetof(Vertex, texture_coordinate));
  attribute(3, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, colour));
}

void append_vertices(const Mesh& mesh, std::vector<Vertex>& vertices) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Rgb colour = mesh.colours.empty() ? Rgb{255, 255, 255} : mesh.colours[i];
    vertices.push_back({mesh.positions[i],
                        mesh.normals.empty() ? glm::vec3(0) : mesh.normals[i],
                        mesh.texture_coordinates.empty() ? glm::vec2(0) : mesh.texture_coordinates[i],
                        {colour.r, colour.g, colour.b, 255}});
  }
}

}  // namespace

Result<SolidPainter> SolidPainter::create() {
  auto program = gl::Program::build("solid", shaders::kSolidVert, shaders::kSolidFrag);
  if (!program) return tl::unexpected<Status>(std::move(program.error()));
  return SolidPainter(*std::move(program));
}

void SolidPainter::show(const Scene& scene, const std::vector<PlacedMesh>& placed) {
  upload_meshes(scene);
  upload_textures(scene);
  instances_.clear();
  for (const PlacedMesh& p : placed) instances_.push_back({static_cast<std::size_t>(p.mesh), glm::mat4(p.place)});
  std::stable_sort(instances_.begin(), instances_.end(), [&](const Instance& a, const Instance& b) {
    const Range &one = meshes_[a.mesh], &other = meshes_[b.mesh];
    return std::pair(one.colours, one.bumps) < std::pair(other.colours, other.bumps);
  });
}

void SolidPainter::upload_meshes(const Scene& scene) {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  meshes_.clear();
  for (const Mesh& mesh : scene.meshes) {
    const auto base = static_cast<std::uint32_t>(vertices.size());
    const Surface surface = mesh.surface < 0 ? Surface{} : scene.surfaces[static_cast<std::size_t>(mesh.surface)];
    const std::size_t none = scene.textures.size();
    meshes_.push_back({indices.size(), mesh.indices->size(),
                       surface.colour < 0 ? none : static_cast<std::size_t>(surface.colour),
                       surface.normals < 0 ? none + 1 : static_cast<std::size_t>(surface.normals)});
    append_vertices(mesh, vertices);
    for (const std::uint32_t index : *mesh.indices) indices.push_back(base + index);
  }
  glBindVertexArray(layout_.id());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)), vertices.data(),
               GL_STATIC_DRAW);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(indices[0])), indices.data(),
               GL_STATIC_DRAW);
  describe_vertices();
}

void SolidPainter::upload_textures(const Scene& scene) {
  textures_.clear();
  for (const Texture& texture : scene.textures) {
    auto* const pixels = reinterpret_cast<cv::Vec3b*>(const_cast<std::uint8_t*>(texture.rgb.data()));  // read only
    upload(cv::Mat3b(texture.height, texture.width, pixels),
           {.wrap = texture.mirrored ? GL_MIRRORED_REPEAT : GL_CLAMP_TO_EDGE}, textures_.emplace_back());
  }
  upload(cv::Mat3b(1, 1, cv::Vec3b(255, 255, 255)), {}, textures_.emplace_back());
  upload(cv::Mat3b(1, 1, cv::Vec3b(128, 128, 255)), {}, textures_.emplace_back());
}

void SolidPainter::draw(const OrbitCamera& camera) {
  const glm::mat4 view_projection(camera.view_projection());
  const glm::vec3 eye(camera.eye());
  glEnable(GL_DEPTH_TEST);
  program_.use();
  glBindVertexArray(layout_.id());
  glUniform1i(program_.uniform("picture"), 0);
  glUniform1i(program_.uniform("bumps"), 1);
  glUniformMatrix4fv(program_.uniform("view_projection"), 1, GL_FALSE, glm::value_ptr(view_projection));
  glUniform3fv(program_.uniform("eye"), 1, glm::value_ptr(eye));
  const GLint place = program_.uniform("place");
  std::optional<std::size_t> bound[2];
  const auto bind = [&](int unit, std::size_t texture) {
    if (bound[unit] == texture) return;
    bound[unit] = texture;
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, textures_[texture].id());
  };
  for (const Instance& instance : instances_) {
    const Range& mesh = meshes_[instance.mesh];
    bind(0, mesh.colours);
    bind(1, mesh.bumps);
    glUniformMatrix4fv(place, 1, GL_FALSE, glm::value_ptr(instance.place));
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(mesh.count), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(mesh.first * sizeof(std::uint32_t)));
  }
  glActiveTexture(GL_TEXTURE0);  // as others expect it
}

}  // namespace tessera::view
