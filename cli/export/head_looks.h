// Textures of recorded heads, and the colours between their lips.
#pragma once

#include <vector>

#include "common/result.h"
#include "decoder/export/head_look.h"
#include "decoder/export/head_recording.h"

namespace fbs::cli {

/// Loads OpenImageIO.
/// @return one for each head of the recording
[[nodiscard]] Result<std::vector<HeadLook>> make_head_looks(const HeadRecording& recording);

}  // namespace fbs::cli
