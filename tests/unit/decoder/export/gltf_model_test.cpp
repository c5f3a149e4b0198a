#include "decoder/export/gltf_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "decoder/export/head_pose_track.h"
#include "decoder/export/tinygltf.h"
#include "tests/unit/decoder/export/recorded_talk.h"
#include "tests/unit/split_head.h"

namespace fbs {
namespace {

/// Not an image: nothing looks inside.
HeadLook toy_look() {
  return {{0x89, 'P', 'N', 'G'}, {}};
}

bool take_any_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*,
                    int, void*) {
  return true;
}

tinygltf::Model read(const std::vector<std::uint8_t>& bytes, bool binary) {
  tinygltf::TinyGLTF reader;
  reader.SetImageLoader(take_any_image, nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const auto size = static_cast<unsigned>(bytes.size());
  const bool done = binary
                        ? reader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(), size)
                        : reader.LoadASCIIFromString(&model, &error, &warning,
                                                     reinterpret_cast<const char*>(bytes.data()), size, "");
  EXPECT_TRUE(done) << error;
  EXPECT_EQ(warning, "");
  return model;
}

tinygltf::Model exported(const HeadRecording& recording, GltfOptions options = {}) {
  const std::vector<HeadLook> looks(recording.heads().size(), toy_look());
  const auto bytes = write_gltf(recording, looks, options);
  EXPECT_TRUE(bytes) << bytes.error().text;
  return read(*bytes, options.binary);
}

HeadRecording toy_recording() {
  HeadRecording recording;
  record(recording, toy_scene(noise_picture(160, 128, 1)), 11);
  return recording;
}

const tinygltf::Accessor& accessor(const tinygltf::Model& model, int index) {
  return model.accessors[static_cast<std::size_t>(index)];
}

std::vector<float> floats(const tinygltf::Model& model, int index) {
  const tinygltf::Accessor& a = accessor(model, index);
  const auto& view = model.bufferViews[static_cast<std::size_t>(a.bufferView)];
  std::vector<float> out(a.count * static_cast<std::size_t>(
                                       tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(a.type))));
  std::memcpy(out.data(), model.buffers[0].data.data() + view.byteOffset + a.byteOffset,
              out.size() * sizeof(float));
  return out;
}

/// Times and values of the channel of a node.
std::pair<std::vector<float>, std::vector<float>> channel(const tinygltf::Model& model,
                                                          const std::string& node, const std::string& path) {
  for (const auto& c : model.animations.at(0).channels) {
    if (c.target_path != path || model.nodes[static_cast<std::size_t>(c.target_node)].name != node) continue;
    const auto& sampler = model.animations[0].samplers[static_cast<std::size_t>(c.sampler)];
    return {floats(model, sampler.input), floats(model, sampler.output)};
  }
  ADD_FAILURE() << "no channel " << path << " of " << node;
  return {};
}

TEST(GltfModel, HasTheHeadWithAllItsTargets) {
  const HeadRecording recording = toy_recording();
  const tinygltf::Model model = exported(recording);
  ASSERT_EQ(model.meshes.size(), 1U);
  const auto& primitives = model.meshes[0].primitives;
  ASSERT_EQ(primitives.size(), 2U);  // face, and the inside of the mouth
  const std::size_t targets = HeadMorphs(toy_geometry()).targets().size();
  EXPECT_EQ(model.meshes[0].weights.size(), targets);
  EXPECT_EQ(model.meshes[0].extras.Get("targetNames").ArrayLen(), targets);
  for (const auto& p : primitives) EXPECT_EQ(p.targets.size(), targets);
  EXPECT_EQ(accessor(model, primitives[0].attributes.at("POSITION")).count, 105U);
  EXPECT_EQ(accessor(model, primitives[1].attributes.at("POSITION")).count, 8U);
}

TEST(GltfModel, StoresMostTargetsSparsely) {
  const tinygltf::Model model = exported(toy_recording());
  std::size_t sparse = 0;
  for (const auto& target : model.meshes[0].primitives[0].targets)
    sparse += accessor(model, target.at("POSITION")).sparse.isSparse ? 1 : 0;
  EXPECT_GT(sparse, model.meshes[0].primitives[0].targets.size() / 2);
}

TEST(GltfModel, NamesVerticesBeyondAByte) {
  HeadRecording recording;
  Scene scene = toy_scene(noise_picture(160, 128, 1));
  scene.set_geometry({scene.setup, split(toy_geometry()), even_surround(10, 8, 0), toy_state()});
  record(recording, scene, 2);
  const tinygltf::Model model = exported(recording);
  const auto& targets = model.meshes[0].primitives[0].targets;
  std::size_t beyond = 0;
  for (const auto& target : targets) {
    const auto& sparse = accessor(model, target.at("POSITION")).sparse;
    if (!sparse.isSparse) continue;
    ASSERT_EQ(sparse.indices.componentType, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
    const auto& view = model.bufferViews[static_cast<std::size_t>(sparse.indices.bufferView)];
    std::vector<std::uint16_t> indices(static_cast<std::size_t>(sparse.count));
    std::memcpy(
        indices.data(),
        model.buffers[0].data.data() + view.byteOffset + static_cast<std::size_t>(sparse.indices.byteOffset),
        indices.size() * sizeof indices[0]);
    EXPECT_TRUE(std::ranges::is_sorted(indices, std::ranges::less_equal()));
    EXPECT_LT(indices.back(), split_head()->vertices.size());
    beyond += indices.back() > 255 ? 1 : 0;
  }
  EXPECT_GT(beyond, 0U);
}

TEST(GltfModel, LeavesOutKeyframesOfSteadyMotion) {
  const tinygltf::Model model = exported(toy_recording());
  // Ten steps at constant speed and the time of the last picture.
  const auto [times, places] = channel(model, "head_0", "translation");
  ASSERT_EQ(times.size(), 3U);
  EXPECT_FLOAT_EQ(times[1], 10 * kToyDuration / 90000.0F);
  EXPECT_FLOAT_EQ(places[0], 80);
  EXPECT_FLOAT_EQ(places[1], -50);  // y up
  EXPECT_FLOAT_EQ(places[3], 85);
  EXPECT_EQ(channel(model, "head_0", "weights").first.size(), 3U);
}

TEST(GltfModel, LastsAsLongAsTheRecording) {
  const tinygltf::Model model = exported(toy_recording());
  for (const char* path : {"translation", "rotation", "scale", "weights"}) {
    const auto times = channel(model, "head_0", path).first;
    EXPECT_FLOAT_EQ(times.front(), 0) << path;
    EXPECT_FLOAT_EQ(times.back(), 11 * kToyDuration / 90000.0F) << path;
  }
}

TEST(GltfModel, IsInMetres) {
  const tinygltf::Model model = exported(toy_recording());
  const auto& picture = model.nodes[static_cast<std::size_t>(model.scenes[0].nodes[0])];
  EXPECT_EQ(picture.name, "picture");
  EXPECT_NEAR(picture.scale[0] * 32, 0.063, 1e-9);  // pixels between the eyes
  EXPECT_NEAR(model.cameras.at(0).orthographic.xmag / picture.scale[0], 80, 1e-6);
  EXPECT_NEAR(model.cameras.at(0).orthographic.ymag / picture.scale[1], 64, 1e-6);
}

TEST(GltfModel, KeepsWidePixelsWide) {
  HeadRecording recording;
  Scene scene = toy_scene(noise_picture(160, 128, 1));
  scene.setup.format.pixel_aspect = {4, 3};
  record(recording, scene, 2);
  const tinygltf::Model model = exported(recording);
  EXPECT_NEAR(model.nodes[0].scale[0] / model.nodes[0].scale[1], 4.0 / 3, 1e-9);
  EXPECT_NEAR(model.cameras.at(0).orthographic.xmag / model.cameras[0].orthographic.ymag, 80 * 4 / 3.0 / 64,
              1e-9);
}

TEST(GltfModel, HidesAHeadWhileAnotherIsShown) {
  HeadRecording recording;
  record(recording, toy_scene(noise_picture(160, 128, 1)), 3);
  record(recording, wider_scene(), 2);
  const tinygltf::Model model = exported(recording);
  EXPECT_EQ(model.meshes.size(), 2U);
  EXPECT_EQ(model.images.size(), 2U);
  const auto [times, scales] = channel(model, "head_1_shown", "scale");
  ASSERT_EQ(times.size(), 3U);
  EXPECT_FLOAT_EQ(times[1], 3 * kToyDuration / 90000.0F);
  EXPECT_FLOAT_EQ(times[2], 5 * kToyDuration / 90000.0F);
  EXPECT_EQ(scales, (std::vector<float>{0, 0, 0, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(channel(model, "head_0_shown", "scale").second, (std::vector<float>{1, 1, 1, 0, 0, 0, 0, 0, 0}));
}

TEST(GltfModel, IsCompressedOnRequest) {
  const HeadRecording recording = toy_recording();
  const std::vector<HeadLook> looks{toy_look()};
  const auto json_of = [&](bool draco) {
    const auto text = write_gltf(recording, looks, {.binary = false, .draco = draco});
    EXPECT_TRUE(text);
    return nlohmann::json::parse(*text);
  };
  const auto model = json_of(true), plain = json_of(false);
  EXPECT_EQ(model["extensionsRequired"], nlohmann::json::array({"KHR_draco_mesh_compression"}));
  EXPECT_FALSE(plain.contains("extensionsRequired"));
  const auto& face = model["meshes"][0]["primitives"][0];
  EXPECT_TRUE(face["extensions"].contains("KHR_draco_mesh_compression"));
  EXPECT_FALSE(model["accessors"][face["attributes"]["POSITION"].get<std::size_t>()].contains("bufferView"));
  EXPECT_LT(model["buffers"][0]["byteLength"], plain["buffers"][0]["byteLength"]);
}

TEST(GltfModel, AsTextHoldsTheSame) {
  const HeadRecording recording = toy_recording();
  const tinygltf::Model text = exported(recording, {.binary = false, .draco = false}),
                        binary = exported(recording);
  EXPECT_EQ(text.buffers[0].data, binary.buffers[0].data);
  EXPECT_EQ(text.accessors.size(), binary.accessors.size());
}

TEST(GltfModel, NeedsAHead) {
  HeadRecording recording;
  record(recording, faceless_scene(), 2);
  const auto written = write_gltf(recording, {}, {});
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kNoFace);
}

}  // namespace
}  // namespace fbs
