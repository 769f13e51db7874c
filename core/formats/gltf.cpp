// glTF 2.0 (Khronos, ISO/IEC 12113:2022). The vertices of all meshes lie in one buffer view an attribute; lists of
// indices that are the same are written once.
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <map>
#include <sstream>

#include "tessera/formats/formats.h"
#include "tessera/formats/jpeg.h"

namespace tessera {
namespace {

namespace gltf = tinygltf;

constexpr int kJpegQuality = 92;
constexpr double kStepsAnEdge = 16;  // at least, of quantized positions
constexpr int kTop16 = 32767, kTop8 = 127, kTopUnsigned16 = 65535;
constexpr std::size_t kMostShortIndices = 65535;  // vertices; 65535 itself is no index

// ---- The buffer

enum Attribute { kPosition, kNormal, kTextureCoordinate, kTangent, kIndex, kTranslation, kRotation, kScale };
constexpr const char* kNames[] = {"POSITION", "NORMAL",      "TEXCOORD_0", "TANGENT",
                                  "",         "TRANSLATION", "ROTATION",   "SCALE"};
constexpr int kTypes[] = {TINYGLTF_TYPE_VEC3,   TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC4,
                          TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4, TINYGLTF_TYPE_VEC3};

// Bytes of one buffer view to be, of values of one kind.
struct Pool {
  Attribute attribute;
  int component_type;
  std::size_t stride;  // a multiple of 4 for vertices
  std::vector<unsigned char> bytes;
};

bool is_vertex(Attribute attribute) { return attribute < kIndex; }

std::size_t rounded_up(std::size_t size) { return (size + 3) / 4 * 4; }

class Writer {
 public:
  explicit Writer(const Scene& scene) : scene_(scene) {}

  gltf::Model model() {
    model_.asset.version = "2.0";
    model_.asset.generator = "Tessera";
    if (!scene_.job_json.empty())
      model_.asset.extras = gltf::Value(gltf::Value::Object{{"job", gltf::Value(scene_.job_json)}});
    for (const Surface& surface : scene_.surfaces) add_surface(surface);
    for (const Mesh& mesh : scene_.meshes) add_mesh(mesh);
    for (const SceneNode& node : scene_.nodes) add_node(node);
    for (const Scene::View& view : scene_.views) {
      gltf::Scene& target = model_.scenes.emplace_back();
      target.name = view.name;
      target.nodes = view.nodes;
    }
    model_.defaultScene = 0;
    add_buffer();
    name_extensions();
    return std::move(model_);
  }

 private:
  // ---- Accessors

  // Values of N components each, appended to their pool: the index of a new accessor.
  template <class T, std::size_t N>
  int add_accessor(Attribute attribute, int component_type, bool normalized,
                   const std::vector<std::array<T, N>>& values) {
    const std::size_t p =
        pool_of(attribute, component_type, is_vertex(attribute) ? rounded_up(N * sizeof(T)) : N * sizeof(T));
    Pool& pool = pools_[p];
    gltf::Accessor& accessor = model_.accessors.emplace_back();
    accessor.bufferView = static_cast<int>(p);
    accessor.byteOffset = pool.bytes.size();
    accessor.componentType = component_type;
    accessor.normalized = normalized;
    accessor.count = values.size();
    accessor.type = kTypes[attribute];
    if (attribute == kPosition) add_bounds(values, accessor);
    pool.bytes.resize(pool.bytes.size() + pool.stride * values.size());
    unsigned char* target = pool.bytes.data() + accessor.byteOffset;
    for (const auto& value : values) {
      std::memcpy(target, value.data(), sizeof(value));
      target += pool.stride;
    }
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  template <class T, std::size_t N>
  static void add_bounds(const std::vector<std::array<T, N>>& values, gltf::Accessor& accessor) {
    for (std::size_t c = 0; c < N; ++c) {
      const auto [least, most] = std::minmax_element(values.begin(), values.end(),
                                                     [&](const auto& a, const auto& b) { return a[c] < b[c]; });
      accessor.minValues.push_back((*least)[c]);
      accessor.maxValues.push_back((*most)[c]);
    }
  }

  std::size_t pool_of(Attribute attribute, int component_type, std::size_t stride) {
    const auto found = std::find_if(pools_.begin(), pools_.end(), [&](const Pool& pool) {
      return pool.attribute == attribute && pool.component_type == component_type;
    });
    if (found != pools_.end()) return static_cast<std::size_t>(found - pools_.begin());
    pools_.push_back({attribute, component_type, stride, {}});
    return pools_.size() - 1;
  }

  // Components times `scale` as T, rounded where T is whole.
  template <class T, class Vector>
  static auto converted(const std::vector<Vector>& values, double scale) {
    constexpr auto size = static_cast<std::size_t>(Vector::length());
    std::vector<std::array<T, size>> result(values.size());
    for (std::size_t v = 0; v < values.size(); ++v)
      for (std::size_t c = 0; c < size; ++c) {
        const double component = values[v][static_cast<int>(c)] * scale;
        result[v][c] = static_cast<T>(std::is_integral_v<T> ? std::round(component) : component);
      }
    return result;
  }

  template <class Vector>
  int add_floats(Attribute attribute, const std::vector<Vector>& values) {
    return add_accessor(attribute, TINYGLTF_COMPONENT_TYPE_FLOAT, false, converted<float>(values, 1));
  }

  // ---- Meshes

  void add_mesh(const Mesh& mesh) {
    gltf::Primitive primitive;
    const bool quantize = scene_.quantize && may_be_quantized(mesh);
    mesh_scales_.push_back(quantize ? reach(mesh) : 1);
    const auto add = [&](Attribute attribute, int accessor) { primitive.attributes[kNames[attribute]] = accessor; };

    add(kPosition, quantize ? add_accessor(kPosition, TINYGLTF_COMPONENT_TYPE_SHORT, true,
                                           converted<std::int16_t>(mesh.positions, kTop16 / mesh_scales_.back()))
                            : add_floats(kPosition, mesh.positions));
    if (!mesh.normals.empty()) add(kNormal, add_directions(kNormal, mesh.normals));
    if (!mesh.tangents.empty()) add(kTangent, add_directions(kTangent, mesh.tangents));
    if (!mesh.texture_coordinates.empty()) add(kTextureCoordinate, add_texture_coordinates(mesh.texture_coordinates));
    primitive.indices = add_indices(mesh);
    primitive.material = mesh.surface;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;

    gltf::Mesh& target = model_.meshes.emplace_back();
    target.name = mesh.name;
    target.primitives.push_back(std::move(primitive));
  }

  template <class Vector>
  int add_directions(Attribute attribute, const std::vector<Vector>& values) {
    if (!scene_.quantize) return add_floats(attribute, values);
    return add_accessor(attribute, TINYGLTF_COMPONENT_TYPE_BYTE, true, converted<std::int8_t>(values, kTop8));
  }

  int add_texture_coordinates(const std::vector<glm::vec2>& values) {
    const auto on_texture = [](glm::vec2 v) { return v.x >= 0 && v.x <= 1 && v.y >= 0 && v.y <= 1; };
    if (!scene_.quantize || !std::all_of(values.begin(), values.end(), on_texture))
      return add_floats(kTextureCoordinate, values);
    return add_accessor(kTextureCoordinate, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, true,
                        converted<std::uint16_t>(values, kTopUnsigned16));
  }

  int add_indices(const Mesh& mesh) {
    const bool is_short = mesh.positions.size() <= kMostShortIndices;
    const auto [known, is_new] = indices_.try_emplace({is_short, mesh.indices}, 0);
    if (!is_new) return known->second;
    if (is_short) {
      std::vector<std::array<std::uint16_t, 1>> values;
      for (const std::uint32_t index : mesh.indices) values.push_back({static_cast<std::uint16_t>(index)});
      return known->second = add_accessor(kIndex, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, false, values);
    }
    std::vector<std::array<std::uint32_t, 1>> values;
    for (const std::uint32_t index : mesh.indices) values.push_back({index});
    return known->second = add_accessor(kIndex, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, false, values);
  }

  // The largest coordinate of a mesh.
  static double reach(const Mesh& mesh) {
    float most = 0;
    for (const glm::vec3& p : mesh.positions) most = std::max({most, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    return most > 0 ? most : 1;
  }

  // Not where its shortest edge would be a few steps only, as in many small things made one mesh.
  static bool may_be_quantized(const Mesh& mesh) {
    const double step = reach(mesh) / kTop16;
    const float least = static_cast<float>(kStepsAnEdge * step * kStepsAnEdge * step);
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3)
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec3 side = mesh.positions[mesh.indices[t + (k + 1) % 3]] - mesh.positions[mesh.indices[t + k]];
        if (const float length = glm::dot(side, side); length > 0 && length < least) return false;
      }
    return true;
  }

  // ---- Nodes

  void add_node(const SceneNode& node) {
    gltf::Node& target = model_.nodes.emplace_back();
    const double mesh_scale = mesh_scales_[static_cast<std::size_t>(node.mesh)];
    const double scale = node.instances.empty() ? node.scale * mesh_scale : node.scale;
    const glm::dvec3& at = node.translation;
    const glm::dquat& turn = node.rotation;
    target.name = node.name;
    target.mesh = node.mesh;
    if (at != glm::dvec3(0)) target.translation = {at.x, at.y, at.z};
    if (turn != glm::dquat(1, 0, 0, 0)) target.rotation = {turn.x, turn.y, turn.z, turn.w};
    if (scale != 1) target.scale = {scale, scale, scale};
    if (!node.extras.empty()) target.extras = extras_of(node);
    if (!node.instances.empty()) target.extensions["EXT_mesh_gpu_instancing"] = instances_of(node, mesh_scale);
    if (node.hull) target.extensions["OMI_collider"] = collider_of(node);
  }

  static gltf::Value extras_of(const SceneNode& node) {
    gltf::Value::Object object;
    for (const auto& [key, extra] : node.extras) {
      if (const double* number = std::get_if<double>(&extra)) {
        object[key] = gltf::Value(*number);
        continue;
      }
      gltf::Value::Array list;
      for (const double v : std::get<std::vector<double>>(extra)) list.emplace_back(v);
      object[key] = gltf::Value(std::move(list));
    }
    return gltf::Value(std::move(object));
  }

  gltf::Value instances_of(const SceneNode& node, double mesh_scale) {
    std::vector<glm::dvec3> translations, scales;
    std::vector<glm::dvec4> rotations;
    for (const SceneNode::Instance& instance : node.instances) {
      const glm::dquat& turn = instance.rotation;
      translations.push_back(instance.translation);
      rotations.emplace_back(turn.x, turn.y, turn.z, turn.w);
      scales.emplace_back(instance.scale * mesh_scale);
    }
    gltf::Value::Object attributes;
    attributes[kNames[kTranslation]] = gltf::Value(add_floats(kTranslation, translations));
    attributes[kNames[kRotation]] = gltf::Value(add_floats(kRotation, rotations));
    attributes[kNames[kScale]] = gltf::Value(add_floats(kScale, scales));
    return gltf::Value(gltf::Value::Object{{"attributes", gltf::Value(std::move(attributes))}});
  }

  gltf::Value collider_of(const SceneNode& node) {
    colliders_.emplace_back(
        gltf::Value::Object{{"type", gltf::Value(std::string("hull"))}, {"mesh", gltf::Value(node.mesh)}});
    return gltf::Value(gltf::Value::Object{{"collider", gltf::Value(static_cast<int>(colliders_.size()) - 1)}});
  }

  // ---- Surfaces

  void add_surface(const Surface& surface) {
    gltf::Material& material = model_.materials.emplace_back();
    material.name = surface.name;
    material.pbrMetallicRoughness.metallicFactor = surface.metallic;
    material.pbrMetallicRoughness.roughnessFactor = surface.roughness;
    material.pbrMetallicRoughness.baseColorTexture.index = texture_of(surface.colour);
    material.normalTexture.index = texture_of(surface.normals);
    if (!surface.visible) {  // every pixel fails the test of its opacity
      material.alphaMode = "MASK";
      material.pbrMetallicRoughness.baseColorFactor = {1, 1, 1, 0};
    }
  }

  // Textures in the order in which they are first used.
  int texture_of(int index) {
    if (index < 0) return -1;
    const auto [known, is_new] = textures_.try_emplace(index, static_cast<int>(model_.textures.size()));
    if (!is_new) return known->second;
    const Texture& texture = scene_.textures[static_cast<std::size_t>(index)];
    gltf::Texture& target = model_.textures.emplace_back();
    target.source = static_cast<int>(images_.size());
    target.sampler = sampler_of(texture);
    images_.push_back(write_jpeg(texture, kJpegQuality));
    return known->second;
  }

  int sampler_of(const Texture& texture) {
    gltf::Sampler sampler;
    sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
    sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
    sampler.wrapS = sampler.wrapT =
        texture.mirrored ? TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT : TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    auto& all = model_.samplers;
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const gltf::Sampler& s) { return s.wrapS == sampler.wrapS; });
    if (found != all.end()) return static_cast<int>(found - all.begin());
    all.push_back(sampler);
    return static_cast<int>(all.size()) - 1;
  }

  // ---- The end

  template <class Bytes>
  gltf::BufferView& append(const Bytes& bytes) {
    std::vector<unsigned char>& data = model_.buffers[0].data;
    gltf::BufferView& view = model_.bufferViews.emplace_back();
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = bytes.size();
    data.insert(data.end(), bytes.begin(), bytes.end());
    data.resize(rounded_up(data.size()));
    return view;
  }

  void add_buffer() {
    if (pools_.empty() && images_.empty()) return;
    std::size_t size = 0;
    for (const Pool& pool : pools_) size += rounded_up(pool.bytes.size());
    for (const std::string& image : images_) size += rounded_up(image.size());
    model_.buffers.emplace_back().data.reserve(size);
    for (Pool& pool : pools_) {
      gltf::BufferView& view = append(pool.bytes);
      view.target = is_vertex(pool.attribute)  ? TINYGLTF_TARGET_ARRAY_BUFFER
                    : pool.attribute == kIndex ? TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER
                                               : 0;
      if (is_vertex(pool.attribute)) view.byteStride = pool.stride;
      std::vector<unsigned char>().swap(pool.bytes);
    }
    for (const std::string& bytes : images_) {
      append(bytes);
      gltf::Image& image = model_.images.emplace_back();
      image.mimeType = "image/jpeg";
      image.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
    }
  }

  void name_extensions() {
    const auto any_node = [&](const auto& test) {
      return std::any_of(scene_.nodes.begin(), scene_.nodes.end(), test);
    };
    if (any_node([](const SceneNode& node) { return !node.instances.empty(); }))
      model_.extensionsUsed.emplace_back("EXT_mesh_gpu_instancing");
    if (scene_.quantize && !scene_.meshes.empty()) {
      model_.extensionsUsed.emplace_back("KHR_mesh_quantization");
      model_.extensionsRequired.emplace_back("KHR_mesh_quantization");
    }
    if (!colliders_.empty()) {
      model_.extensionsUsed.emplace_back("OMI_collider");
      model_.extensions["OMI_collider"] =
          gltf::Value(gltf::Value::Object{{"colliders", gltf::Value(std::move(colliders_))}});
    }
  }

  const Scene& scene_;
  gltf::Model model_;
  std::vector<Pool> pools_;
  std::map<std::pair<bool, std::vector<std::uint32_t>>, int> indices_;  // accessors of lists that are known
  std::map<int, int> textures_;                                         // ours -> the file's
  std::vector<std::string> images_;
  std::vector<double> mesh_scales_;  // metres to a unit of each mesh's positions
  gltf::Value::Array colliders_;
};

std::string write(const Scene& scene, bool binary) {
  const gltf::Model model = Writer(scene).model();
  std::ostringstream stream;
  gltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, binary);
  return std::move(stream).str();
}

}  // namespace

std::string write_glb(const Scene& scene) { return write(scene, true); }
std::string write_gltf(const Scene& scene) { return write(scene, false); }

}  // namespace tessera
