// A mesh for each picture, numbered from 1, with one material library.
#pragma once

#include <string>

#include "cli/files/number_pattern.h"
#include "common/result.h"
#include "decoder/export/head_recording.h"

namespace fbs::cli {

/// The pattern of `head_%05d.obj`.
/// @return kUnsupported where the name has no number, or more than one
[[nodiscard]] Result<NumberPattern> obj_pattern(const std::string& output);

/// Writes the meshes, and for `folder/head_%05d.obj` the materials `folder/head.mtl` and the textures
/// `folder/head.png`, `folder/head_1.png` ... of the heads. No file gets its name before all are complete.
/// @return kNoFace when the recording has no head
[[nodiscard]] Result<void> write_obj_sequence(const HeadRecording& recording, const NumberPattern& pattern);

}  // namespace fbs::cli
