#include "decoder/export/gltf_model.h"

#include <algorithm>
#include <exception>
#include <sstream>
#include <string>

#include "decoder/export/gltf_animation.h"
#include "decoder/export/gltf_mesh.h"
#include "decoder/export/picture_frame.h"

namespace fbs {
namespace {

int add_node(tinygltf::Model& model, tinygltf::Node node, int parent = -1) {
  const auto index = static_cast<int>(model.nodes.size());
  model.nodes.push_back(std::move(node));
  if (parent >= 0) model.nodes[static_cast<std::size_t>(parent)].children.push_back(index);
  return index;
}

std::vector<double> numbers(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

int add_picture_node(tinygltf::Model& model, const PictureFrame& frame) {
  tinygltf::Node node;
  node.name = "picture";
  node.scale = numbers(frame.scale());
  node.translation = numbers(frame.corner());
  return add_node(model, node);
}

int add_camera(tinygltf::Model& model, const PictureFrame& frame, const HeadRecording& recording) {
  double largest = 0;
  for (const RecordedHead& head : recording.heads())
    for (const RecordedState& s : head.states) largest = std::max(largest, model_pose(s.state).scale);
  constexpr double kHeadDepth = 8;  // eye distances, more than kMaxCoordinate from the head's origin
  const double distance = kHeadDepth * largest * frame.pixel;
  tinygltf::Camera camera;
  camera.type = "orthographic";
  camera.name = "picture";
  camera.orthographic.xmag = frame.width / 2 * frame.pixel * frame.aspect;
  camera.orthographic.ymag = frame.height / 2 * frame.pixel;
  camera.orthographic.znear = distance / 1000;
  camera.orthographic.zfar = 2 * distance;
  model.cameras.push_back(camera);
  tinygltf::Node node;
  node.name = "camera";
  node.camera = 0;
  node.translation = {0, 0, distance};
  return add_node(model, node);
}

/// A head shown in all pictures needs no switch.
int add_switch(tinygltf::Model& model, GltfBuffer& buffer, const HeadRecording& recording, std::size_t head,
               int parent, tinygltf::Animation& animation) {
  if (recording.shown().size() == 1) return parent;
  tinygltf::Node node;
  node.name = "head_" + std::to_string(head) + "_shown";
  const double scale = recording.shown().front().head == head ? 1 : 0;
  node.scale = numbers(glm::dvec3(scale));
  const int index = add_node(model, node, parent);
  animate_visibility(buffer, recording, head, index, animation);
  return index;
}

Result<void> add_head(tinygltf::Model& model, GltfBuffer& buffer, const HeadRecording& recording,
                      std::size_t number, const HeadLook& look, bool draco, int picture,
                      tinygltf::Animation& animation) {
  const RecordedHead& head = recording.heads()[number];
  const HeadMorphs morphs(head.geometry);
  tinygltf::Node node;
  node.name = "head_" + std::to_string(number);
  auto mesh = add_head_mesh(model, buffer, head, look, morphs, node.name, draco);
  if (!mesh) return fail(mesh.error());
  const ModelPose pose = model_pose(head.states.front().state);
  node.mesh = *mesh;
  node.translation = numbers(pose.translation);
  node.rotation = {pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w};
  node.scale = numbers(glm::dvec3(pose.scale));
  const int parent = add_switch(model, buffer, recording, number, picture, animation);
  animate_head(buffer, head, morphs, recording.duration(), add_node(model, node, parent), animation);
  return {};
}

Result<tinygltf::Model> make_model(const HeadRecording& recording, std::span<const HeadLook> looks,
                                   bool draco) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "fbs export";
  GltfBuffer buffer(model);
  const PictureFrame frame(recording.format(), recording.first_scale());
  const int picture = add_picture_node(model, frame);
  tinygltf::Animation animation;
  animation.name = "talk";
  for (std::size_t h = 0; h < recording.heads().size(); ++h)
    if (auto added = add_head(model, buffer, recording, h, looks[h], draco, picture, animation); !added)
      return fail(added.error());
  buffer.finish_displacements();
  model.animations.push_back(animation);
  tinygltf::Scene scene;
  scene.nodes = {picture, add_camera(model, frame, recording)};
  model.scenes.push_back(scene);
  model.defaultScene = 0;
  return model;
}

}  // namespace

Result<std::vector<std::uint8_t>> write_gltf(const HeadRecording& recording, std::span<const HeadLook> looks,
                                             const GltfOptions& options) try {
  if (recording.heads().empty()) return fail(ErrorCode::kNoFace, "no scene has a face");
  auto model = make_model(recording, looks, options.draco);
  if (!model) return fail(model.error());
  std::ostringstream out;
  tinygltf::TinyGLTF writer;
  if (!writer.WriteGltfSceneToStream(&*model, out, !options.binary, options.binary))
    return fail(ErrorCode::kInternal, "tinygltf cannot write the model");
  const std::string bytes = out.str();
  return std::vector<std::uint8_t>(bytes.begin(), bytes.end());
} catch (const std::exception& problem) {
  return fail(ErrorCode::kInternal, std::string("tinygltf cannot write the model: ") + problem.what());
}

}  // namespace fbs
