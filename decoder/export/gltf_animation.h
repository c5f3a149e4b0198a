// Pose, expression and visibility of heads as a glTF animation.
#pragma once

#include "decoder/export/gltf_buffer.h"
#include "decoder/export/head_pose_track.h"

namespace fbs {

/// Adds translation, rotation and scale of a node and the weights of its mesh.
/// @param duration  of the whole animation, 1/90000 s; each channel has a keyframe there
void animate_head(GltfBuffer& buffer, const RecordedHead& head, const HeadMorphs& morphs,
                  std::uint64_t duration, int node, tinygltf::Animation& animation);

/// Scales a node to nothing while another head, or none, is shown.
void animate_visibility(GltfBuffer& buffer, const HeadRecording& recording, std::size_t head, int node,
                        tinygltf::Animation& animation);

}  // namespace fbs
