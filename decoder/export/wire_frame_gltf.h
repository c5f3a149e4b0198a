// Reads a wire-frame from a glTF file like common/generic_head.gltf: docs/wire-frames.md.
#pragma once

#include <memory>
#include <string>

#include "common/result.h"
#include "common/wire_frame.h"

namespace fbs {

/// The first primitive of the first mesh, in eye distances, y up and z toward the viewer; `extras` of the
/// mesh gives the meaning of its vertices.
/// @param name  .glb is binary, anything else is JSON
/// @return kIo               the file cannot be read, or is not glTF
///         kInvalidArgument  it has no mesh with triangles, or no such extras, or make_wire_frame() refuses
///                           them
[[nodiscard]] Result<std::shared_ptr<const WireFrame>> read_wire_frame_gltf(const std::string& name);

}  // namespace fbs
