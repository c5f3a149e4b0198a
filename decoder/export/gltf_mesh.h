// The mesh of one head in a glTF model, with its materials.
#pragma once

#include <vector>

#include "common/result.h"
#include "decoder/export/gltf_buffer.h"
#include "decoder/export/head_look.h"
#include "decoder/export/head_pose_track.h"

namespace fbs {

/// Adds mesh, materials, texture and image.
/// @param name  of the mesh, and the start of its materials' names
/// @return index of the mesh
[[nodiscard]] Result<int> add_head_mesh(tinygltf::Model& model, GltfBuffer& buffer, const RecordedHead& head,
                                        const HeadLook& look, const HeadMorphs& morphs,
                                        const std::string& name, bool draco);

}  // namespace fbs
