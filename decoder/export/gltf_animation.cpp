#include "decoder/export/gltf_animation.h"

#include <glm/gtc/quaternion.hpp>
#include <string>

#include "decoder/export/keyframes.h"
#include "decoder/head/head_projection.h"

namespace fbs {
namespace {

// Tolerances: the effect of one unit of the state's integers, so that rounding in the stream's own
// interpolation does not count.
constexpr double kTranslationTolerance = 1.0 / (1 << kScreenOneLog2);  ///< pixels
constexpr double kRotationTolerance = 1e-4;  ///< of a quaternion's components: two units of 2^-16 turn
constexpr double kScaleTolerance = 2e-4;     ///< relative: 2^-12 octave

double seconds(std::uint64_t ticks) {
  return static_cast<double>(ticks) / kTicksPerSecond;
}

/// Numbers over time.
struct Curve {
  std::vector<double> times;   ///< s
  std::vector<double> values;  ///< as many for each time as there are tolerances
  std::vector<double> tolerance;

  void add(double time, std::initializer_list<double> value) {
    times.push_back(time);
    values.insert(values.end(), value);
  }
};

/// A channel with the keyframes of the curve that matter.
/// @param type  TINYGLTF_TYPE_... of the values
void add_channel(GltfBuffer& buffer, const Curve& curve, int node, const char* path, int type,
                 const char* interpolation, tinygltf::Animation& animation) {
  std::vector<float> times, values;
  const std::size_t size = curve.tolerance.size();
  for (const std::size_t key : find_keyframes(curve.times, curve.values, curve.tolerance)) {
    const auto time = static_cast<float>(curve.times[key]);
    if (!times.empty() && time <= times.back()) continue;  // floats hours into a recording are this coarse
    times.push_back(time);
    for (std::size_t i = 0; i < size; ++i) values.push_back(static_cast<float>(curve.values[key * size + i]));
  }
  tinygltf::AnimationSampler sampler;
  sampler.input = buffer.add_animated(times, TINYGLTF_TYPE_SCALAR, true);
  sampler.output = buffer.add_animated(values, type, false);
  sampler.interpolation = interpolation;
  animation.samplers.push_back(sampler);
  tinygltf::AnimationChannel channel;
  channel.sampler = static_cast<int>(animation.samplers.size()) - 1;
  channel.target_node = node;
  channel.target_path = path;
  animation.channels.push_back(channel);
}

/// The one nearer to `before` of a rotation's two quaternions, so that interpolation goes the short way.
glm::dquat nearer(const glm::dquat& q, const glm::dquat& before) {
  return glm::dot(q, before) < 0 ? -q : q;
}

}  // namespace

void animate_head(GltfBuffer& buffer, const RecordedHead& head, const HeadMorphs& morphs,
                  std::uint64_t duration, int node, tinygltf::Animation& animation) {
  Curve translation, rotation, scale, weights;
  translation.tolerance.assign(3, kTranslationTolerance);
  rotation.tolerance.assign(4, kRotationTolerance);
  weights.tolerance = morphs.tolerances();
  scale.tolerance.assign(3, kScaleTolerance * model_pose(head.states.front().state).scale);
  glm::dquat last(1, 0, 0, 0);
  const auto add = [&](double time, const State& state) {
    const ModelPose pose = model_pose(state);
    last = nearer(pose.rotation, last);
    translation.add(time, {pose.translation.x, pose.translation.y, pose.translation.z});
    rotation.add(time, {last.x, last.y, last.z, last.w});
    scale.add(time, {pose.scale, pose.scale, pose.scale});
    weights.times.push_back(time);
    const auto w = morphs.weights(state);
    weights.values.insert(weights.values.end(), w.begin(), w.end());
  };
  for (const RecordedState& s : head.states) add(seconds(s.time), s.state);
  add(seconds(duration), head.states.back().state);
  add_channel(buffer, translation, node, "translation", TINYGLTF_TYPE_VEC3, "LINEAR", animation);
  add_channel(buffer, rotation, node, "rotation", TINYGLTF_TYPE_VEC4, "LINEAR", animation);
  add_channel(buffer, scale, node, "scale", TINYGLTF_TYPE_VEC3, "LINEAR", animation);
  add_channel(buffer, weights, node, "weights", TINYGLTF_TYPE_SCALAR, "LINEAR", animation);
}

void animate_visibility(GltfBuffer& buffer, const HeadRecording& recording, std::size_t head, int node,
                        tinygltf::Animation& animation) {
  Curve shown;
  shown.tolerance.assign(3, -1);  // steps: keep every keyframe
  const auto add = [&](std::uint64_t time, bool visible) {
    const double scale = visible ? 1 : 0;
    shown.add(seconds(time), {scale, scale, scale});
  };
  for (const ShownHead& s : recording.shown()) add(s.begin, s.head == head);
  add(recording.duration(), recording.shown().back().head == head);
  add_channel(buffer, shown, node, "scale", TINYGLTF_TYPE_VEC3, "STEP", animation);
}

}  // namespace fbs
