#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>

#include "tessera/formats/formats.h"

namespace tessera {
namespace {

using nlohmann::json;
using testing::ElementsAre;

Indices triangles(std::vector<std::uint32_t> indices) {
  return std::make_shared<const std::vector<std::uint32_t>>(std::move(indices));
}

// A tetrahedron twice, the second one moved, turned and three times as large, and a texture.
Scene two_tetrahedra() {
  Mesh mesh;
  mesh.name = "tetrahedron";
  mesh.positions = {{0, 0, 0}, {0.5, 0, 0}, {0, 0.25, 0}, {0, 0, 0.125}};
  mesh.normals = {{-0.6f, 0, -0.8f}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.texture_coordinates = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0.5}};
  mesh.indices = triangles({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
  mesh.surface = 0;
  Scene scene;
  scene.textures.push_back({2, 2, {250, 0, 0, 250, 0, 0, 250, 0, 0, 250, 0, 0}});
  scene.surfaces.push_back({"stone", 0.75, 0, 0, -1, true});
  scene.meshes = {mesh, mesh};
  SceneNode first, second;
  first.name = "first";
  first.mesh = 0;
  first.extras = {{"area_px", 12.5}, {"radii", std::vector<double>{1, 2.25}}};
  second.name = "second";
  second.mesh = 1;
  second.translation = {1, 2, 3};
  second.rotation = glm::dquat(0, 0, 1, 0);
  second.scale = 3;
  scene.nodes = {first, second};
  scene.views = {{"all", {0, 1}}, {"one", {1}}};
  return scene;
}

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

struct Glb {
  json document;
  std::string binary;

  // Component c of element k of an accessor, as a number in the file.
  template <class T>
  T value(int accessor, std::size_t k, std::size_t c) const {
    const json& a = document["accessors"][static_cast<std::size_t>(accessor)];
    const json& view = document["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::size_t stride = view.value("byteStride", sizeof(T));
    T out;
    std::memcpy(&out,
                binary.data() + view.value("byteOffset", 0) + a.value("byteOffset", 0) + k * stride + c * sizeof(T),
                sizeof(T));
    return out;
  }
  const json& attributes(std::size_t mesh) const { return document["meshes"][mesh]["primitives"][0]["attributes"]; }
};

Glb parsed(const std::string& bytes) {
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(word(bytes, 4), 2U);
  EXPECT_EQ(word(bytes, 8), bytes.size());
  const std::size_t text = word(bytes, 12);
  EXPECT_EQ(text % 4, 0U);
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  Glb glb{json::parse(bytes.substr(20, text)), {}};
  if (20 + text == bytes.size()) return glb;
  EXPECT_EQ(word(bytes, 20 + text), bytes.size() - 28 - text);
  EXPECT_EQ(bytes.substr(24 + text, 4), std::string("BIN\0", 4));
  glb.binary = bytes.substr(28 + text);
  EXPECT_EQ(glb.document["buffers"][0]["byteLength"], glb.binary.size());
  return glb;
}

TEST(WriteGlb, HoldsNodesMeshesAndTheirNumbers) {
  const Glb glb = parsed(write_glb(two_tetrahedra()));
  const json& d = glb.document;
  EXPECT_EQ(d["asset"]["version"], "2.0");
  EXPECT_EQ(d["scenes"].size(), 2U);
  EXPECT_EQ(d["scenes"][1]["nodes"], json({1}));
  EXPECT_EQ(d["nodes"][0]["extras"], json({{"area_px", 12.5}, {"radii", {1, 2.25}}}));
  EXPECT_FALSE(d["nodes"][0].contains("translation"));
  EXPECT_EQ(d["nodes"][1]["translation"], json({1, 2, 3}));
  EXPECT_EQ(d["nodes"][1]["rotation"], json({0, 1, 0, 0}));
  EXPECT_EQ(d["nodes"][1]["scale"], json({3, 3, 3}));
  EXPECT_FALSE(d.contains("extensionsUsed"));
  const int positions = glb.attributes(1)["POSITION"], normals = glb.attributes(1)["NORMAL"],
            places = glb.attributes(1)["TEXCOORD_0"];
  EXPECT_EQ(glb.value<float>(positions, 3, 2), 0.125f);
  EXPECT_EQ(glb.value<float>(normals, 0, 2), -0.8f);
  EXPECT_EQ(glb.value<float>(places, 3, 1), 0.5f);
  const json& accessor = d["accessors"][static_cast<std::size_t>(positions)];
  EXPECT_EQ(accessor["min"], json({0, 0, 0}));
  EXPECT_EQ(accessor["max"], json({0.5, 0.25, 0.125}));
  const int indices = d["meshes"][0]["primitives"][0]["indices"];
  EXPECT_EQ(glb.value<std::uint16_t>(indices, 1, 0), 2);
}

TEST(WriteGlb, ColoursAreLinearLight) {
  Scene scene = two_tetrahedra();
  scene.meshes[1].colours = {{255, 0, 0}, {0, 128, 1}, {0, 0, 255}, {10, 10, 10}};
  const Glb glb = parsed(write_glb(scene));
  EXPECT_FALSE(glb.attributes(0).contains("COLOR_0"));
  const int colours = glb.attributes(1)["COLOR_0"];
  const json& accessor = glb.document["accessors"][static_cast<std::size_t>(colours)];
  EXPECT_EQ(accessor["normalized"], true);
  EXPECT_EQ(glb.value<std::uint16_t>(colours, 0, 0), 65535);
  EXPECT_NEAR(glb.value<std::uint16_t>(colours, 1, 1) / 65535.0, 0.215861, 1e-5);  // IEC 61966-2-1
  EXPECT_NEAR(glb.value<std::uint16_t>(colours, 1, 2) / 65535.0, 1 / 255.0 / 12.92, 1e-5);
}

TEST(WriteGlb, ListsOfTrianglesThatMeshesShareAreWrittenOnce) {
  const json d = parsed(write_glb(two_tetrahedra())).document;
  EXPECT_EQ(d["meshes"][0]["primitives"][0]["indices"], d["meshes"][1]["primitives"][0]["indices"]);
  EXPECT_EQ(d["accessors"].size(), 7U);
}

TEST(WriteGlb, ViewsLieOneAfterAnotherAtMultiplesOf4) {
  Scene scene = two_tetrahedra();
  scene.meshes[1].indices = triangles({0, 2, 1});
  for (const bool quantize : {false, true}) {
    scene.quantize = quantize;
    const Glb glb = parsed(write_glb(scene));
    std::size_t end = 0;
    for (const json& view : glb.document["bufferViews"]) {
      const std::size_t start = view["byteOffset"];
      EXPECT_EQ(start, (end + 3) / 4 * 4);
      EXPECT_EQ(view.value("byteStride", 4) % 4, 0);
      end = start + view["byteLength"].get<std::size_t>();
    }
    EXPECT_EQ((end + 3) / 4 * 4, glb.binary.size());
  }
}

TEST(WriteGlb, TexturesAreJpeg) {
  const Glb glb = parsed(write_glb(two_tetrahedra()));
  const json& image = glb.document["images"][0];
  EXPECT_EQ(image["mimeType"], "image/jpeg");
  const json& view = glb.document["bufferViews"][image["bufferView"].get<std::size_t>()];
  const std::string jpeg = glb.binary.substr(view["byteOffset"], view["byteLength"]);
  EXPECT_EQ(jpeg.substr(0, 2), "\xff\xd8");
  EXPECT_EQ(jpeg.substr(jpeg.size() - 2), "\xff\xd9");
  const json& material = glb.document["materials"][0];
  EXPECT_EQ(material["pbrMetallicRoughness"],
            json({{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0}, {"roughnessFactor", 0.75}}));
}

TEST(WriteGlb, QuantizedPositionsTimesTheNodesScaleAreThePositions) {
  Scene scene = two_tetrahedra();
  scene.quantize = true;
  const Glb glb = parsed(write_glb(scene));
  EXPECT_EQ(glb.document["extensionsRequired"], json({"KHR_mesh_quantization"}));
  const double scales[] = {1, 3};  // of the nodes as given
  for (std::size_t node = 0; node < 2; ++node) {
    const double scale = glb.document["nodes"][node]["scale"][0];
    const int positions = glb.attributes(node)["POSITION"];
    for (std::size_t k = 0; k < 4; ++k)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(glb.value<std::int16_t>(positions, k, static_cast<std::size_t>(c)) / 32767.0 * scale,
                    scales[node] * scene.meshes[0].positions[k][c], 1e-4);
    EXPECT_EQ(glb.value<std::int8_t>(glb.attributes(node)["NORMAL"], 0, 2), std::lround(-0.8 * 127));
    EXPECT_EQ(glb.value<std::uint16_t>(glb.attributes(node)["TEXCOORD_0"], 1, 0), 65535);
  }
}

TEST(WriteGlb, AMeshWhoseEdgesWouldBeOfAFewStepsStaysAsItIs) {
  Scene scene = two_tetrahedra();
  scene.quantize = true;
  scene.meshes[0].positions[3] = {0, 0, 1e-5f};
  const Glb glb = parsed(write_glb(scene));
  EXPECT_EQ(glb.value<float>(glb.attributes(0)["POSITION"], 3, 2), 1e-5f);
  EXPECT_EQ(glb.document["accessors"][glb.attributes(1)["POSITION"].get<std::size_t>()]["componentType"], 5122);
}

TEST(WriteGlb, ManyVerticesHaveLongIndices) {
  for (const std::size_t count : {65535UL, 65536UL}) {
    Scene scene;
    Mesh mesh;
    mesh.positions.assign(count, glm::vec3(0));
    mesh.positions[1] = {1, 0, 0};
    mesh.positions.back() = {0, 1, 0};
    mesh.indices = triangles({0, 1, static_cast<std::uint32_t>(count) - 1});
    scene.meshes.push_back(mesh);
    const json accessors = parsed(write_glb(scene)).document["accessors"];
    EXPECT_EQ(accessors.back()["componentType"], count == 65535 ? 5123 : 5125);
  }
}

TEST(WriteGlb, InstancesAndHullsAreExtensions) {
  Scene scene = two_tetrahedra();
  scene.nodes[0].instances = {{{1, 0, 2}, glm::dquat(1, 0, 0, 0), 0.5}, {{3, 0, 4}, glm::dquat(0, 0, 1, 0), 1.5}};
  scene.nodes[1].hull = true;
  const Glb glb = parsed(write_glb(scene));
  const json& d = glb.document;
  EXPECT_EQ(d["extensionsUsed"], json({"EXT_mesh_gpu_instancing", "OMI_collider"}));
  const json& attributes = d["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  const auto value = [&](const char* name, std::size_t size, std::size_t k, std::size_t c) {
    return glb.value<float>(attributes[name], size * k + c, 0);
  };
  EXPECT_EQ(value("TRANSLATION", 3, 1, 2), 4);
  EXPECT_EQ(value("ROTATION", 4, 1, 1), 1);
  EXPECT_EQ(value("SCALE", 3, 0, 2), 0.5f);
  EXPECT_EQ(d["nodes"][1]["extensions"]["OMI_collider"]["collider"], 0);
  EXPECT_EQ(d["extensions"]["OMI_collider"]["colliders"], json::parse(R"([{"type": "hull", "mesh": 1}])"));
}

TEST(WriteGlb, CarriesTheJob) {
  Scene scene;
  scene.job_json = R"({"technique":"pebbles","seed":7})";
  scene.views = {{"all", {}}};
  const Glb glb = parsed(write_glb(scene));
  EXPECT_EQ(glb.document["asset"]["extras"]["job"]["seed"], 7);
  EXPECT_TRUE(glb.binary.empty());
}

std::string decoded_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 0xff);
  }
  return bytes;
}

TEST(WriteGltf, IsTheSameDocumentWithItsBufferInside) {
  const Scene scene = two_tetrahedra();
  const Glb glb = parsed(write_glb(scene));
  json text = json::parse(write_gltf(scene));
  const std::string uri = text["buffers"][0]["uri"], head = "data:application/octet-stream;base64,";
  EXPECT_EQ(uri.substr(0, head.size()), head);
  EXPECT_EQ(decoded_base64(uri.substr(head.size())), glb.binary);
  text["buffers"][0].erase("uri");
  EXPECT_EQ(text, glb.document);
}

}  // namespace
}  // namespace tessera
