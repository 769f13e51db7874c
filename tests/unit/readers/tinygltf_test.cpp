// Our GLB read by a library that shares nothing with the writer.
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <string>
#include <vector>

#include "../pebbles/beach.h"
#include "tessera/formats/formats.h"
#include "tessera/pebbles/run.h"

namespace tessera::pebbles {
namespace {

using tinygltf::Accessor;
using tinygltf::Model;

constexpr int kColumns = 5, kRows = 4;
constexpr std::size_t kPebbles = std::size_t{kColumns} * kRows;

// The painted stones and, as a label picture, where they are.
struct Input {
  Beach beach = paint_beach(kColumns, kRows, 3);
  cv::Mat3b labels = cv::Mat3b::zeros(beach.photo.size());
  std::vector<double> areas = std::vector<double>(kPebbles);  // px

  Input() {
    for (std::size_t k = 0; k < kPebbles; ++k)
      for (int y = 0; y < labels.rows; ++y)
        for (int x = 0; x < labels.cols; ++x)
          if (beach.stones[k].holds(x + 0.5, y + 0.5)) {
            labels(y, x) = {static_cast<std::uint8_t>(k + 1), 0, 0};
            areas[k] += 1;
          }
    std::sort(areas.begin(), areas.end());
  }
};

ImageView view_of(const cv::Mat3b& pixels) {
  return {pixels.data, pixels.cols, pixels.rows, static_cast<std::ptrdiff_t>(pixels.step)};
}

Model field(Params params) {
  params.segmenter = Segmenter::kLabels;
  const Input input;
  const auto output = run({view_of(input.beach.photo), view_of(input.labels)}, params, 1, {});
  EXPECT_TRUE(output.has_value());
  const std::string glb = write_glb(output->scene);
  Model model;
  std::string errors, warnings;
  EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromMemory(&model, &errors, &warnings,
                                                        reinterpret_cast<const unsigned char*>(glb.data()),
                                                        static_cast<unsigned>(glb.size())));
  EXPECT_EQ(errors, "");
  EXPECT_EQ(warnings, "");
  return model;
}

template <class T>
std::vector<double> values_of(const Model& model, const Accessor& accessor) {
  const auto& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
  const auto& bytes = model.buffers[static_cast<std::size_t>(view.buffer)].data;
  const int stride = accessor.ByteStride(view);
  const int size = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
  EXPECT_GT(stride, 0);
  std::vector<double> values;
  for (std::size_t k = 0; k < accessor.count; ++k)
    for (int c = 0; c < size; ++c) {
      T value{};
      std::memcpy(&value,
                  bytes.data() + view.byteOffset + accessor.byteOffset + k * static_cast<std::size_t>(stride) +
                      static_cast<std::size_t>(c) * sizeof(T),
                  sizeof(T));
      values.push_back(static_cast<double>(value));
    }
  return values;
}

const Accessor& accessor_of(const Model& model, const tinygltf::Primitive& primitive, const std::string& name) {
  return model.accessors[static_cast<std::size_t>(primitive.attributes.at(name))];
}

// Bounds of positions are those in the accessor, and triangles name vertices of theirs.
template <class Position>
void expect_sound_meshes(const Model& model, int component) {
  for (const tinygltf::Mesh& mesh : model.meshes) {
    ASSERT_EQ(mesh.primitives.size(), 1U);
    const tinygltf::Primitive& primitive = mesh.primitives[0];
    const Accessor& positions = accessor_of(model, primitive, "POSITION");
    EXPECT_EQ(positions.componentType, component);
    const auto places = values_of<Position>(model, positions);
    std::vector<double> least(places.begin(), places.begin() + 3), most = least;
    for (std::size_t k = 0; k < places.size(); ++k) {
      least[k % 3] = std::min(least[k % 3], places[k]);
      most[k % 3] = std::max(most[k % 3], places[k]);
    }
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(static_cast<Position>(positions.minValues.at(c)), least[c]);
      EXPECT_EQ(static_cast<Position>(positions.maxValues.at(c)), most[c]);
    }
    for (const char* name : {"NORMAL", "TEXCOORD_0"})
      EXPECT_EQ(accessor_of(model, primitive, name).count, positions.count);
    const Accessor& indices = model.accessors[static_cast<std::size_t>(primitive.indices)];
    ASSERT_EQ(indices.componentType, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
    const auto corners = values_of<std::uint16_t>(model, indices);
    EXPECT_EQ(std::set<double>(corners.begin(), corners.end()).size(), positions.count);
    EXPECT_EQ(*std::max_element(corners.begin(), corners.end()), static_cast<double>(positions.count) - 1);
  }
}

void expect_photo(const Model& model) {
  ASSERT_EQ(model.images.size(), 1U);
  EXPECT_EQ(model.images[0].width, 42 * kColumns);
  EXPECT_EQ(model.images[0].height, 42 * kRows);
  EXPECT_EQ(model.images[0].mimeType, "image/jpeg");
  ASSERT_EQ(model.materials.size(), 1U);
  EXPECT_EQ(model.materials[0].pbrMetallicRoughness.baseColorTexture.index, 0);
}

TEST(ReadByTinyGltf, AMeshAndANodeAPebble) {
  const Model model = field({});
  EXPECT_EQ(model.meshes.size(), kPebbles);
  ASSERT_EQ(model.nodes.size(), kPebbles);
  EXPECT_EQ(model.scenes[0].nodes.size(), kPebbles);
  std::vector<double> areas;
  for (std::size_t i = 0; i < kPebbles; ++i) {
    EXPECT_EQ(model.nodes[i].name, "pebble-" + std::to_string(i + 1));
    areas.push_back(model.nodes[i].extras.Get("area_px").GetNumberAsDouble());
    EXPECT_EQ(model.nodes[i].extras.Get("centre_px").ArrayLen(), 2U);
  }
  std::sort(areas.begin(), areas.end());
  const std::vector<double> painted = Input().areas;
  for (std::size_t i = 0; i < kPebbles; ++i) EXPECT_NEAR(areas[i] / painted[i], 1, 0.03);
  expect_sound_meshes<float>(model, TINYGLTF_COMPONENT_TYPE_FLOAT);
  expect_photo(model);
}

TEST(ReadByTinyGltf, OneMeshOfAll) {
  Params params;
  params.layout = FieldLayout::kMerged;
  const Model merged = field(params);
  ASSERT_EQ(merged.meshes.size(), 1U);
  EXPECT_EQ(merged.nodes.size(), 1U);
  expect_sound_meshes<float>(merged, TINYGLTF_COMPONENT_TYPE_FLOAT);
  expect_photo(merged);
  std::size_t vertices = 0;
  const Model apart = field({});
  for (const tinygltf::Mesh& mesh : apart.meshes)
    vertices += accessor_of(apart, mesh.primitives[0], "POSITION").count;
  EXPECT_EQ(accessor_of(merged, merged.meshes[0].primitives[0], "POSITION").count, vertices);
}

TEST(ReadByTinyGltf, WholeNumbersInPlaceOfFloats) {
  Params params;
  params.quantize = true;
  const Model model = field(params);
  EXPECT_EQ(model.extensionsRequired, std::vector<std::string>{"KHR_mesh_quantization"});
  EXPECT_EQ(model.meshes.size(), kPebbles);
  expect_sound_meshes<std::int16_t>(model, TINYGLTF_COMPONENT_TYPE_SHORT);
  expect_photo(model);
  const Model plain = field({});
  for (std::size_t i = 0; i < kPebbles; ++i) {
    const double scale = model.nodes[i].scale[0] / 32767;
    const auto& whole = accessor_of(model, model.meshes[i].primitives[0], "POSITION");
    const auto& real = accessor_of(plain, plain.meshes[i].primitives[0], "POSITION");
    EXPECT_TRUE(whole.normalized);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(scale * whole.maxValues[c], real.maxValues[c], scale);
  }
}

TEST(ReadByTinyGltf, StrewnPebblesAreInstances) {
  Params params;
  params.scatter = 60;
  const Model model = field(params);
  std::size_t strewn = 0;
  for (const tinygltf::Node& node : model.nodes) {
    const auto found = node.extensions.find("EXT_mesh_gpu_instancing");
    ASSERT_NE(found, node.extensions.end());
    const tinygltf::Value& attributes = found->second.Get("attributes");
    const auto accessor = [&](const char* name) {
      return model.accessors[static_cast<std::size_t>(attributes.Get(name).GetNumberAsInt())];
    };
    for (const double scale : values_of<float>(model, accessor("SCALE"))) EXPECT_GT(scale, 0);
    EXPECT_EQ(accessor("ROTATION").count, accessor("TRANSLATION").count);
    strewn += accessor("TRANSLATION").count;
  }
  EXPECT_EQ(strewn, 60U);
  expect_sound_meshes<float>(model, TINYGLTF_COMPONENT_TYPE_FLOAT);
  expect_photo(model);
}

}  // namespace
}  // namespace tessera::pebbles
