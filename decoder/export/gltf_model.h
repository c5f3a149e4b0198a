// A recording as a glTF 2.0 model: heads with textures, morph targets and animation.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/result.h"
#include "decoder/export/head_look.h"
#include "decoder/export/head_recording.h"

namespace fbs {

struct GltfOptions {
  bool binary = true;  ///< .glb; otherwise .gltf with everything inside, as data URIs
  bool draco = false;  ///< KHR_draco_mesh_compression where it applies: meshes without morph targets
};

/// The model's nodes:
///
///   picture            pixels, y up, origin in the upper left corner of the picture; scaled to metres:
///     |                the first head has kEyeDistanceMetres between its eyes in its first picture
///     +- head_K_shown  scaled to nothing while the stream shows another head, or none; only if that happens
///          +- head_K   eye distances in the head's own frame; animated translation, rotation, scale, weights
///   camera             orthographic; sees what the picture shows
///
/// The middle of the picture is the origin. Animations last from 0 s to the end of the last picture.
/// Keyframes that linear interpolation reproduces within a unit of the stream's own integers are left out.
/// @param looks  of each head of the recording
/// @return kNoFace if the recording has no head; kInternal if a library fails
[[nodiscard]] Result<std::vector<std::uint8_t>> write_gltf(const HeadRecording& recording,
                                                           std::span<const HeadLook> looks,
                                                           const GltfOptions& options);

}  // namespace fbs
