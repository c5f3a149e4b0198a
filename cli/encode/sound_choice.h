// Which sound is encoded beside the pictures.
#pragma once

#include "cli/source/encoder_module.h"
#include "common/result.h"
#include "encoder/sound/sound_encoder.h"

namespace fbs::cli {

/// By the options, and where they are silent by the quality or the bitrate of the whole.
/// @param live  short frames, for a short delay
/// @return kInvalidArgument for a rate that the codec does not have
[[nodiscard]] Result<SoundSettings> sound_settings(const EncodeArguments& arguments, bool live);

/// What the sound takes of a stream, kbit/s: frames, their sizes and the headers of packets.
[[nodiscard]] double sound_kbps(const SoundSettings& settings);

}  // namespace fbs::cli
