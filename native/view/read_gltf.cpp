#include "tessera/view/read_gltf.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <utility>

namespace tessera::view {
namespace {

tl::unexpected<Status> refused(std::string message) {
  return fail(StatusCode::kInvalidInput, "", "cannot be shown: " + std::move(message));
}

template <class List>
bool holds(const List& list, int index) {
  return index >= 0 && static_cast<std::size_t>(index) < list.size();
}

// A component as the number that it stands for.
template <class T>
double component(const unsigned char* bytes, bool normalized) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  if constexpr (std::is_integral_v<T>)
    if (normalized) return std::max(static_cast<double>(value) / std::numeric_limits<T>::max(), -1.0);
  return static_cast<double>(value);
}

double component(const unsigned char* bytes, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return component<std::int8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return component<std::uint8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT: return component<std::int16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return component<std::uint16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return component<std::uint32_t>(bytes, false);
    default: return component<float>(bytes, false);
  }
}

// The nearest level of a channel to so much light, 0..1.
std::uint8_t level_of(double light) {
  const auto& table = linear_light();
  const double wanted = std::clamp(light, 0.0, 1.0) * 65535;
  const auto above = std::lower_bound(table.begin(), table.end(), wanted);
  if (above == table.begin()) return 0;
  if (above == table.end()) return 255;
  const bool is_below = wanted - *(above - 1) < *above - wanted;
  return static_cast<std::uint8_t>(above - table.begin() - (is_below ? 1 : 0));
}

// Fills a Scene from the model. The first problem stops it; what is read after one is empty.
class Reader {
 public:
  explicit Reader(const tinygltf::Model& model) : model_(model) {}

  Result<Scene> scene() {
    for (const tinygltf::Image& image : model_.images) scene_.textures.push_back(texture_of(image));
    for (const tinygltf::Material& material : model_.materials) scene_.surfaces.push_back(surface_of(material));
    for (const tinygltf::Mesh& mesh : model_.meshes) scene_.meshes.push_back(mesh_of(mesh));
    for (const tinygltf::Node& node : model_.nodes) scene_.nodes.push_back(node_of(node));
    for (const tinygltf::Scene& scene : model_.scenes) {
      for (const int node : scene.nodes) require(holds(model_.nodes, node), "a scene names a node that is not there");
      scene_.views.push_back({scene.name, scene.nodes});
    }
    if (holds(scene_.views, model_.defaultScene)) std::swap(scene_.views[0], scene_.views[model_.defaultScene]);
    require(!scene_.views.empty(), "there is no scene");
    if (!problem_.empty()) return refused(problem_);
    return std::move(scene_);
  }

 private:
  bool require(bool condition, const char* complaint) {
    if (!condition && problem_.empty()) problem_ = complaint;
    return condition;
  }

  Texture texture_of(const tinygltf::Image& image) {
    const auto pixels = static_cast<std::size_t>(std::max(image.width, 0)) * std::max(image.height, 0);
    const auto channels = static_cast<std::size_t>(std::max(image.component, 0));
    const bool readable = pixels > 0 && channels >= 3 && image.bits == 8 && image.image.size() >= pixels * channels;
    if (!require(readable, "a picture in it is damaged")) return {};
    Texture texture{image.width, image.height, std::vector<std::uint8_t>(3 * pixels), false};
    for (std::size_t i = 0; i < pixels; ++i) std::copy_n(&image.image[i * channels], 3, &texture.rgb[3 * i]);
    return texture;
  }

  int texture_at(int index) {
    if (index < 0) return -1;
    if (!require(holds(model_.textures, index) && holds(model_.images, model_.textures[index].source),
                 "a material names a texture that is not there"))
      return -1;
    const tinygltf::Texture& texture = model_.textures[static_cast<std::size_t>(index)];
    if (holds(model_.samplers, texture.sampler))
      scene_.textures[static_cast<std::size_t>(texture.source)].mirrored =
          model_.samplers[static_cast<std::size_t>(texture.sampler)].wrapS == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT;
    return texture.source;
  }

  Surface surface_of(const tinygltf::Material& material) {
    const tinygltf::PbrMetallicRoughness& look = material.pbrMetallicRoughness;
    const bool visible = material.alphaMode != "MASK" || look.baseColorFactor.size() != 4 ||
                         look.baseColorFactor[3] >= material.alphaCutoff;
    return {material.name,
            look.roughnessFactor,
            look.metallicFactor,
            texture_at(look.baseColorTexture.index),
            texture_at(material.normalTexture.index),
            visible};
  }

  // Calls take(i, numbers) for each of the accessor's vectors, `count` numbers each. How many there were.
  template <class Take>
  std::size_t each_vector(int index, int count, Take&& take) {
    const char* const damaged = "a list in it is damaged";
    if (!require(holds(model_.accessors, index), damaged)) return 0;
    const tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(index)];
    if (!require(!accessor.sparse.isSparse && holds(model_.bufferViews, accessor.bufferView), damaged)) return 0;
    const tinygltf::BufferView& view = model_.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType));
    const int stride = accessor.ByteStride(view);
    if (!require(holds(model_.buffers, view.buffer) && size > 0 && stride >= size * count &&
                     tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) >= count,
                 damaged))
      return 0;
    const std::vector<unsigned char>& buffer = model_.buffers[static_cast<std::size_t>(view.buffer)].data;
    const std::size_t start = view.byteOffset + accessor.byteOffset, step = static_cast<std::size_t>(stride);
    const std::size_t one = static_cast<std::size_t>(size) * count;
    const bool fits = view.byteOffset <= buffer.size() && start >= view.byteOffset && start <= buffer.size() &&
                      (accessor.count == 0 ||
                       (buffer.size() - start >= one && (buffer.size() - start - one) / step >= accessor.count - 1));
    if (!require(fits, damaged)) return 0;
    double numbers[4] = {};
    for (std::size_t i = 0; i < accessor.count; ++i) {
      for (int c = 0; c < count; ++c) {
        numbers[c] = component(&buffer[start + i * step + static_cast<std::size_t>(c) * size], accessor.componentType,
                               accessor.normalized);
        if (!require(std::isfinite(numbers[c]), "a number in it is not finite")) return i;
      }
      take(i, numbers);
    }
    return accessor.count;
  }

  template <class Vector>
  std::vector<Vector> vectors(const tinygltf::Primitive& primitive, const char* name) {
    std::vector<Vector> list;
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) return list;
    each_vector(found->second, Vector::length(), [&](std::size_t, const double* v) {
      Vector value;
      for (int c = 0; c < Vector::length(); ++c) value[c] = static_cast<float>(v[c]);
      list.push_back(value);
    });
    return list;
  }

  Mesh mesh_of(const tinygltf::Mesh& from) {
    Mesh mesh;
    mesh.name = from.name;
    if (!require(from.primitives.size() == 1 && (from.primitives[0].mode == TINYGLTF_MODE_TRIANGLES),
                 "a mesh is not one list of triangles"))
      return mesh;
    const tinygltf::Primitive& primitive = from.primitives[0];
    mesh.positions = vectors<glm::vec3>(primitive, "POSITION");
    mesh.normals = vectors<glm::vec3>(primitive, "NORMAL");
    for (glm::vec3& n : mesh.normals)
      if (const float length = glm::length(n); length > 0) n /= length;
    mesh.texture_coordinates = vectors<glm::vec2>(primitive, "TEXCOORD_0");
    for (const glm::vec3 c : vectors<glm::vec3>(primitive, "COLOR_0"))
      mesh.colours.push_back({level_of(c.x), level_of(c.y), level_of(c.z)});
    const std::size_t count = mesh.positions.size();
    for (const std::size_t size : {mesh.normals.size(), mesh.texture_coordinates.size(), mesh.colours.size()})
      require(size == 0 || size == count, "a mesh's lists are not equally long");
    std::vector<std::uint32_t> indices;
    each_vector(primitive.indices, 1, [&](std::size_t, const double* v) {
      require(v[0] >= 0 && v[0] < static_cast<double>(count), "a triangle names a vertex that is not there");
      indices.push_back(static_cast<std::uint32_t>(v[0]));
    });
    require(count > 0 && indices.size() % 3 == 0, "a mesh is not one list of triangles");
    mesh.indices = std::make_shared<const std::vector<std::uint32_t>>(std::move(indices));
    mesh.surface = primitive.material;
    require(mesh.surface < 0 || holds(model_.materials, mesh.surface), "a mesh names a material that is not there");
    return mesh;
  }

  SceneNode node_of(const tinygltf::Node& from) {
    SceneNode node;
    node.name = from.name;
    node.mesh = from.mesh;
    if (!require(from.children.empty() && from.matrix.empty() && holds(model_.meshes, from.mesh),
                 "a node is not a mesh and its place"))
      return node;
    if (const auto& t = from.translation; t.size() == 3) node.translation = {t[0], t[1], t[2]};
    if (const auto& r = from.rotation; r.size() == 4) node.rotation = {r[3], r[0], r[1], r[2]};
    if (const auto& s = from.scale; s.size() == 3) node.scale = s[0];
    node.hull = from.extensions.count("OMI_collider") != 0;
    const auto instancing = from.extensions.find("EXT_mesh_gpu_instancing");
    if (instancing != from.extensions.end()) node.instances = instances_of(instancing->second.Get("attributes"));
    return node;
  }

  std::vector<SceneNode::Instance> instances_of(const tinygltf::Value& attributes) {
    std::vector<SceneNode::Instance> instances;
    const auto each = [&](const char* name, int count, auto&& take) {
      if (!attributes.Has(name)) return;
      each_vector(attributes.Get(name).GetNumberAsInt(), count, [&](std::size_t i, const double* v) {
        if (i >= instances.size()) instances.resize(i + 1);
        take(instances[i], v);
      });
    };
    each("TRANSLATION", 3, [](auto& i, const double* v) { i.translation = {v[0], v[1], v[2]}; });
    each("ROTATION", 4, [](auto& i, const double* v) { i.rotation = {v[3], v[0], v[1], v[2]}; });
    each("SCALE", 3, [](auto& i, const double* v) { i.scale = v[0]; });
    return instances;
  }

  const tinygltf::Model& model_;
  Scene scene_;
  std::string problem_;
};

constexpr const char* kMagic = "glTF";

bool is_binary(const std::string& bytes) { return bytes.compare(0, 4, kMagic) == 0; }

}  // namespace

bool looks_like_gltf(const std::string& bytes) {
  const std::string start = bytes.substr(0, 256);
  return is_binary(start) ||
         (start.find_first_not_of(" \t\r\n") == start.find('{') && start.find("\"asset\"") != std::string::npos);
}

Result<Scene> read_gltf(const std::string& bytes) {
  tinygltf::Model model;
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks({nullptr, nullptr, nullptr, nullptr, nullptr});  // no files beside the file
  std::string error, warning;
  const auto size = static_cast<unsigned>(bytes.size());
  const bool loaded = is_binary(bytes)
                          ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                                        reinterpret_cast<const unsigned char*>(bytes.data()), size)
                          : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, "");
  if (!loaded) {
    const std::size_t end = std::min(error.find('\n'), error.size());
    return refused(end == 0 ? std::string("it is a damaged glTF")
                            : "it is a damaged glTF (" + error.substr(0, end) + ")");
  }
  return Reader(model).scene();
}

}  // namespace tessera::view
