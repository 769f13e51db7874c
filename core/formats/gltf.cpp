// glTF 2.0 (Khronos, ISO/IEC 12113:2022). The vertices of all meshes lie in one buffer view an attribute. Fields have
// tens of thousands of meshes: the JSON is text from the start, and values are converted where they are written to,
// so that memory is that of the scene and of the file.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <type_traits>

#include "tessera/formats/formats.h"
#include "tessera/formats/jpeg.h"

namespace tessera {
namespace {

constexpr int kJpegQuality = 92;
constexpr double kStepsAnEdge = 16;  // at least, of quantized positions
constexpr int kTop16 = 32767, kTop8 = 127, kTopUnsigned16 = 65535;
constexpr std::size_t kMostShortIndices = 65535;  // vertices; 65535 itself is no index

// The specification's numbers.
constexpr int kByte = 5120, kShort = 5122, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr int kVertices = 34962, kTriangles = 34963;
constexpr int kLinear = 9729, kLinearMipmapLinear = 9987, kClampToEdge = 33071, kMirroredRepeat = 33648;
constexpr std::uint32_t kGlb = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

enum class Attribute {
  kPosition,
  kNormal,
  kTangent,
  kTextureCoordinate,
  kColour,
  kIndex,
  kTranslation,
  kRotation,
  kScale
};

bool is_vertex(Attribute attribute) { return attribute < Attribute::kIndex; }

std::size_t rounded_up(std::size_t size) { return (size + 3) / 4 * 4; }

// ---- Text

// Numbers as short as they can be read back.
template <class Values>
std::string json_list(const Values& values) {
  return fmt::format("[{}]", fmt::join(values, ","));
}

std::string json_list(const glm::dvec3& v) { return json_list(std::array{v.x, v.y, v.z}); }
std::string json_list(const glm::dquat& v) { return json_list(std::array{v.x, v.y, v.z, v.w}); }

// Members or elements with commas between them.
class List {
 public:
  template <class... Args>
  int add(fmt::format_string<Args...> format, Args&&... args) {
    if (count_ > 0) text_ += ',';
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
    return count_++;
  }
  int count() const { return count_; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  int count_ = 0;
};

// ---- Bytes

template <class T>
void append(std::string& bytes, const T* values, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

// Components times `scale` as T, rounded where T is whole, each vector filled up to a multiple of 4 bytes.
template <class T, class Vector>
void append_vectors(std::string& bytes, const std::vector<Vector>& values, double scale) {
  constexpr auto size = static_cast<std::size_t>(Vector::length());
  if constexpr (std::is_same_v<T, typename Vector::value_type> && sizeof(Vector) == size * sizeof(T))
    if (scale == 1) return append(bytes, values.data(), values.size());
  std::array<T, (size * sizeof(T) + 3) / 4 * 4 / sizeof(T)> out{};
  for (const Vector& value : values) {
    for (std::size_t c = 0; c < size; ++c) {
      const auto component = value[static_cast<int>(c)] * scale;
      if constexpr (std::is_integral_v<T>) {
        out[c] = static_cast<T>(std::round(component));
      } else {
        out[c] = static_cast<T>(component);
      }
    }
    append(bytes, out.data(), out.size());
  }
}

std::string base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return k < bytes.size() ? static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[k])) : 0U;
    };
    const std::uint32_t three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (int shift = 18; shift >= 0; shift -= 6) text += kDigits[three >> shift & 63];
  }
  for (std::size_t k = bytes.size(); k % 3 != 0; ++k) text[text.size() - (k % 3 == 1 ? 2 : 1)] = '=';
  return text;
}

// ---- The document

// One buffer view: values of one kind, from many accessors, written at the end.
struct View {
  Attribute attribute;
  int component_type;
  std::size_t stride;  // bytes a value
  std::size_t size = 0;
  std::vector<std::function<void(std::string&)>> parts{};
};

class Document {
 public:
  explicit Document(const Scene& scene) : scene_(scene) {
    for (const Surface& surface : scene_.surfaces) add_surface(surface);
    for (const Mesh& mesh : scene_.meshes) add_mesh(mesh);
    for (const SceneNode& node : scene_.nodes) add_node(node);
    for (const Scene::View& view : scene_.views) {
      const std::string nodes = view.nodes.empty() ? "" : fmt::format(",\"nodes\":{}", json_list(view.nodes));
      scenes_.add(R"({{"name":"{}"{}}})", view.name, nodes);
    }
    for (const View& view : views_) describe(view);
    for (const std::string& image : images_) {
      image_list_.add(R"({{"bufferView":{},"mimeType":"image/jpeg"}})", buffer_views_.count());
      buffer_views_.add(R"({{"buffer":0,"byteOffset":{},"byteLength":{}}})", buffer_size_, image.size());
      buffer_size_ += rounded_up(image.size());
    }
  }

  std::size_t buffer_size() const { return buffer_size_; }

  // The JSON; `uri` is a member of the buffer, or empty.
  std::string text(const std::string& uri) const {
    List members;
    members.add(R"("asset":{{"version":"2.0","generator":"Tessera"{}}})",
                scene_.job_json.empty() ? "" : fmt::format(R"(,"extras":{{"job":{}}})", scene_.job_json));
    add_extensions(members);
    if (scenes_.count() > 0) members.add("\"scene\":0");
    const std::pair<const char*, const List*> lists[] = {
        {"scenes", &scenes_},       {"nodes", &nodes_},         {"meshes", &meshes_},
        {"materials", &materials_}, {"textures", &textures_},   {"images", &image_list_},
        {"samplers", &samplers_},   {"accessors", &accessors_}, {"bufferViews", &buffer_views_}};
    for (const auto& [key, list] : lists)
      if (list->count() > 0) members.add("\"{}\":[{}]", key, list->text());
    if (buffer_size_ > 0) members.add(R"("buffers":[{{"byteLength":{}{}}}])", buffer_size_, uri);
    return "{" + members.text() + "}";
  }

  void append_buffer(std::string& bytes) const {
    const std::size_t start = bytes.size();
    const auto fill_up = [&] { bytes.resize(start + rounded_up(bytes.size() - start), '\0'); };
    for (const View& view : views_) {
      for (const auto& part : view.parts) part(bytes);
      fill_up();
    }
    for (const std::string& image : images_) {
      bytes += image;
      fill_up();
    }
  }

 private:
  // ---- Accessors

  // `count` values that `part` appends to their view: the index of a new accessor. `more` are members of it.
  int add_accessor(Attribute attribute, int component_type, const char* type, std::size_t stride, std::size_t count,
                   const std::string& more, std::function<void(std::string&)> part) {
    const auto same = [&](const View& v) { return v.attribute == attribute && v.component_type == component_type; };
    auto view = std::find_if(views_.begin(), views_.end(), same);
    if (view == views_.end()) view = views_.insert(view, View{attribute, component_type, stride});
    const std::size_t offset = view->size;
    view->size += stride * count;
    view->parts.push_back(std::move(part));
    return accessors_.add(R"({{"bufferView":{},"byteOffset":{},"componentType":{},"count":{},"type":"{}"{}}})",
                          view - views_.begin(), offset, component_type, count, type, more);
  }

  // Vectors times `scale` as numbers of type T. They are the scene's and stay where they are.
  template <class T, class Vector>
  int add_vectors(Attribute attribute, int component_type, const std::vector<Vector>& values, double scale,
                  const std::string& more = {}) {
    constexpr const char* kTypes[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    constexpr auto size = static_cast<std::size_t>(Vector::length());
    return add_accessor(attribute, component_type, kTypes[size], rounded_up(size * sizeof(T)), values.size(),
                        (std::is_integral_v<T> ? ",\"normalized\":true" : "") + more,
                        [&values, scale](std::string& bytes) { append_vectors<T>(bytes, values, scale); });
  }

  template <class Vector>
  int add_floats(Attribute attribute, const std::vector<Vector>& values, const std::string& more = {}) {
    return add_vectors<float>(attribute, kFloat, values, 1, more);
  }

  // ---- Meshes

  void add_mesh(const Mesh& mesh) {
    const bool quantize = scene_.quantize && may_be_quantized(mesh);
    mesh_scales_.push_back(quantize ? reach(mesh) : 1);
    List attributes;
    attributes.add("\"POSITION\":{}", add_positions(mesh.positions, quantize, kTop16 / mesh_scales_.back()));
    if (!mesh.normals.empty()) attributes.add("\"NORMAL\":{}", add_directions(Attribute::kNormal, mesh.normals));
    if (!mesh.tangents.empty()) attributes.add("\"TANGENT\":{}", add_directions(Attribute::kTangent, mesh.tangents));
    if (!mesh.texture_coordinates.empty())
      attributes.add("\"TEXCOORD_0\":{}", add_texture_coordinates(mesh.texture_coordinates));
    if (!mesh.colours.empty()) attributes.add("\"COLOR_0\":{}", add_colours(mesh.colours));
    const std::string material = mesh.surface < 0 ? "" : fmt::format(",\"material\":{}", mesh.surface);
    const std::string name = mesh.name.empty() ? "" : fmt::format("\"name\":\"{}\",", mesh.name);
    meshes_.add(R"({{{}"primitives":[{{"attributes":{{{}}},"indices":{}{}}}]}})", name, attributes.text(),
                add_indices(mesh), material);
  }

  int add_positions(const std::vector<glm::vec3>& positions, bool quantize, double scale) {
    glm::vec3 least = positions.front(), most = least;
    for (const glm::vec3& p : positions)
      for (int c = 0; c < 3; ++c) {
        least[c] = std::min(least[c], p[c]);
        most[c] = std::max(most[c], p[c]);
      }
    if (!quantize)
      return add_floats(Attribute::kPosition, positions,
                        fmt::format(",\"min\":{},\"max\":{}", json_list(std::array{least.x, least.y, least.z}),
                                    json_list(std::array{most.x, most.y, most.z})));
    const auto whole = [&](float v) { return static_cast<int>(std::round(v * scale)); };
    return add_vectors<std::int16_t>(
        Attribute::kPosition, kShort, positions, scale,
        fmt::format(",\"min\":{},\"max\":{}", json_list(std::array{whole(least.x), whole(least.y), whole(least.z)}),
                    json_list(std::array{whole(most.x), whole(most.y), whole(most.z)})));
  }

  template <class Vector>
  int add_directions(Attribute attribute, const std::vector<Vector>& values) {
    return scene_.quantize ? add_vectors<std::int8_t>(attribute, kByte, values, kTop8)
                           : add_floats(attribute, values);
  }

  int add_texture_coordinates(const std::vector<glm::vec2>& values) {
    const auto on_texture = [](glm::vec2 v) { return v.x >= 0 && v.x <= 1 && v.y >= 0 && v.y <= 1; };
    if (!scene_.quantize || !std::all_of(values.begin(), values.end(), on_texture))
      return add_floats(Attribute::kTextureCoordinate, values);
    return add_vectors<std::uint16_t>(Attribute::kTextureCoordinate, kUnsignedShort, values, kTopUnsigned16);
  }

  // Linear light, of which 8 bits are too few in the dark.
  int add_colours(const std::vector<Rgb>& colours) {
    return add_accessor(Attribute::kColour, kUnsignedShort, "VEC3", 8, colours.size(), ",\"normalized\":true",
                        [&colours](std::string& bytes) {
                          const auto light = [](std::uint8_t level) {
                            return static_cast<std::uint16_t>(linear_light()[level]);
                          };
                          for (const Rgb c : colours) {
                            const std::array<std::uint16_t, 4> value{light(c.r), light(c.g), light(c.b), 0};
                            append(bytes, value.data(), value.size());
                          }
                        });
  }

  // A list that meshes share is written once.
  int add_indices(const Mesh& mesh) {
    const std::vector<std::uint32_t>* list = mesh.indices.get();
    const auto [known, is_new] = indices_.try_emplace({list, mesh.positions.size() <= kMostShortIndices}, 0);
    if (!is_new) return known->second;
    if (!known->first.second)
      return known->second = add_accessor(Attribute::kIndex, kUnsignedInt, "SCALAR", 4, list->size(), {},
                                          [list](std::string& bytes) { append(bytes, list->data(), list->size()); });
    return known->second = add_accessor(Attribute::kIndex, kUnsignedShort, "SCALAR", 2, list->size(), {},
                                        [list](std::string& bytes) {
                                          for (const std::uint32_t index : *list) {
                                            const auto value = static_cast<std::uint16_t>(index);
                                            append(bytes, &value, 1);
                                          }
                                        });
  }

  // The largest coordinate of a mesh.
  static double reach(const Mesh& mesh) {
    float most = 0;
    for (const glm::vec3& p : mesh.positions) most = std::max({most, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    return most > 0 ? most : 1;
  }

  // Not where its shortest edge would be a few steps only, as in many small things made one mesh.
  static bool may_be_quantized(const Mesh& mesh) {
    const double step = reach(mesh) / kTop16, least = kStepsAnEdge * step * kStepsAnEdge * step;
    const std::vector<std::uint32_t>& indices = *mesh.indices;
    for (std::size_t t = 0; t + 2 < indices.size(); t += 3)
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec3 side = mesh.positions[indices[t + (k + 1) % 3]] - mesh.positions[indices[t + k]];
        if (const double squared = glm::dot(side, side); squared > 0 && squared < least) return false;
      }
    return true;
  }

  // ---- Nodes

  void add_node(const SceneNode& node) {
    const double mesh_scale = mesh_scales_[static_cast<std::size_t>(node.mesh)];
    const double scale = node.instances.empty() ? node.scale * mesh_scale : node.scale;
    List members;
    members.add("\"name\":\"{}\"", node.name);
    members.add("\"mesh\":{}", node.mesh);
    if (node.translation != glm::dvec3(0)) members.add("\"translation\":{}", json_list(node.translation));
    if (node.rotation != glm::dquat(1, 0, 0, 0)) members.add("\"rotation\":{}", json_list(node.rotation));
    if (scale != 1) members.add("\"scale\":{}", json_list(glm::dvec3(scale)));
    if (!node.extras.empty()) members.add("\"extras\":{{{}}}", extras_of(node));
    if (!node.instances.empty()) members.add("\"extensions\":{{{}}}", instances_of(node, mesh_scale));
    if (node.hull) members.add(R"("extensions":{{"OMI_collider":{{"collider":{}}}}})", collider_of(node.mesh));
    nodes_.add("{{{}}}", members.text());
  }

  // Nodes of one mesh share its collider.
  int collider_of(int mesh) {
    const auto [known, is_new] = known_colliders_.try_emplace(mesh, colliders_.count());
    if (is_new) colliders_.add(R"({{"type":"hull","mesh":{}}})", mesh);
    return known->second;
  }

  static std::string extras_of(const SceneNode& node) {
    List members;
    for (const auto& [key, extra] : node.extras) {
      const double* number = std::get_if<double>(&extra);
      members.add("\"{}\":{}", key,
                  number ? fmt::format("{}", *number) : json_list(std::get<std::vector<double>>(extra)));
    }
    return members.text();
  }

  std::string instances_of(const SceneNode& node, double mesh_scale) {
    const auto add = [&](Attribute attribute, const char* type, int size, auto&& value_of) {
      const std::vector<SceneNode::Instance>& all = node.instances;
      return add_accessor(attribute, kFloat, type, 4 * static_cast<std::size_t>(size), all.size(), {},
                          [&all, value_of](std::string& bytes) {
                            for (const SceneNode::Instance& instance : all) {
                              const auto value = value_of(instance);
                              append(bytes, value.data(), value.size());
                            }
                          });
    };
    const auto f = [](double v) { return static_cast<float>(v); };
    const int translations = add(Attribute::kTranslation, "VEC3", 3, [f](const SceneNode::Instance& i) {
      return std::array{f(i.translation.x), f(i.translation.y), f(i.translation.z)};
    });
    const int rotations = add(Attribute::kRotation, "VEC4", 4, [f](const SceneNode::Instance& i) {
      return std::array{f(i.rotation.x), f(i.rotation.y), f(i.rotation.z), f(i.rotation.w)};
    });
    const int scales = add(Attribute::kScale, "VEC3", 3, [f, mesh_scale](const SceneNode::Instance& i) {
      const float scale = f(i.scale * mesh_scale);
      return std::array{scale, scale, scale};
    });
    has_instances_ = true;
    return fmt::format(R"("EXT_mesh_gpu_instancing":{{"attributes":{{"TRANSLATION":{},"ROTATION":{},"SCALE":{}}}}})",
                       translations, rotations, scales);
  }

  // ---- Surfaces

  void add_surface(const Surface& surface) {
    List look;
    if (!surface.visible) look.add("\"baseColorFactor\":[1,1,1,0]");
    if (surface.colour >= 0) look.add(R"("baseColorTexture":{{"index":{}}})", texture_of(surface.colour));
    look.add("\"metallicFactor\":{}", surface.metallic);
    look.add("\"roughnessFactor\":{}", surface.roughness);
    List members;
    members.add("\"name\":\"{}\"", surface.name);
    members.add("\"pbrMetallicRoughness\":{{{}}}", look.text());
    if (surface.normals >= 0) members.add(R"("normalTexture":{{"index":{}}})", texture_of(surface.normals));
    if (!surface.visible) members.add("\"alphaMode\":\"MASK\"");  // every pixel fails the test of its opacity
    materials_.add("{{{}}}", members.text());
  }

  // Textures in the order in which they are first used.
  int texture_of(int index) {
    const auto [known, is_new] = known_textures_.try_emplace(index, textures_.count());
    if (!is_new) return known->second;
    const Texture& texture = scene_.textures[static_cast<std::size_t>(index)];
    textures_.add(R"({{"sampler":{},"source":{}}})", sampler_of(texture), images_.size());
    images_.push_back(write_jpeg(texture, kJpegQuality));
    return known->second;
  }

  int sampler_of(const Texture& texture) {
    const int wrap = texture.mirrored ? kMirroredRepeat : kClampToEdge;
    const auto [known, is_new] = known_samplers_.try_emplace(wrap, samplers_.count());
    if (is_new)
      samplers_.add(R"({{"magFilter":{},"minFilter":{},"wrapS":{},"wrapT":{}}})", kLinear, kLinearMipmapLinear, wrap,
                    wrap);
    return known->second;
  }

  // ---- The rest

  void describe(const View& view) {
    std::string more;
    if (is_vertex(view.attribute)) more = fmt::format(",\"byteStride\":{},\"target\":{}", view.stride, kVertices);
    if (view.attribute == Attribute::kIndex) more = fmt::format(",\"target\":{}", kTriangles);
    buffer_views_.add(R"({{"buffer":0,"byteOffset":{},"byteLength":{}{}}})", buffer_size_, view.size, more);
    buffer_size_ += rounded_up(view.size);
  }

  void add_extensions(List& members) const {
    List used;
    if (has_instances_) used.add("\"EXT_mesh_gpu_instancing\"");
    if (scene_.quantize && meshes_.count() > 0) used.add("\"KHR_mesh_quantization\"");
    if (colliders_.count() > 0) used.add("\"OMI_collider\"");
    if (used.count() == 0) return;
    members.add("\"extensionsUsed\":[{}]", used.text());
    if (scene_.quantize && meshes_.count() > 0) members.add("\"extensionsRequired\":[\"KHR_mesh_quantization\"]");
    if (colliders_.count() > 0)
      members.add(R"("extensions":{{"OMI_collider":{{"colliders":[{}]}}}})", colliders_.text());
  }

  const Scene& scene_;
  std::vector<View> views_;
  std::map<std::pair<const std::vector<std::uint32_t>*, bool>, int> indices_;  // accessors; looked up, never walked
  std::map<int, int> known_textures_, known_samplers_, known_colliders_;       // ours -> the file's
  std::vector<std::string> images_;
  std::vector<double> mesh_scales_;  // metres to a unit of each mesh's positions
  bool has_instances_ = false;
  std::size_t buffer_size_ = 0;
  List scenes_, nodes_, meshes_, materials_, textures_, image_list_, samplers_, accessors_, buffer_views_, colliders_;
};

void append_word(std::string& bytes, std::size_t word) {
  const auto value = static_cast<std::uint32_t>(word);
  append(bytes, &value, 1);
}

}  // namespace

std::string write_glb(const Scene& scene) {
  const Document document(scene);
  std::string json = document.text("");
  json.resize(rounded_up(json.size()), ' ');
  const std::size_t binary = document.buffer_size() == 0 ? 0 : 8 + document.buffer_size();
  std::string bytes;
  bytes.reserve(20 + json.size() + binary);
  for (const std::size_t word : {std::size_t{kGlb}, std::size_t{2}, 20 + json.size() + binary})
    append_word(bytes, word);
  for (const std::size_t word : {json.size(), std::size_t{kJsonChunk}}) append_word(bytes, word);
  bytes += json;
  if (binary == 0) return bytes;
  for (const std::size_t word : {document.buffer_size(), std::size_t{kBinaryChunk}}) append_word(bytes, word);
  document.append_buffer(bytes);
  return bytes;
}

std::string write_gltf(const Scene& scene) {
  const Document document(scene);
  std::string buffer;
  buffer.reserve(document.buffer_size());
  document.append_buffer(buffer);
  return document.text(fmt::format(R"(,"uri":"data:application/octet-stream;base64,{}")", base64(buffer))) + "\n";
}

}  // namespace tessera
