// Chooses the sound encoded with the pictures.
#pragma once

#include "cli/source/encoder_module.h"
#include "common/result.h"
#include "encoder/sound/sound_encoder.h"

namespace fbs::cli {

/// From the options or, where they are silent, from the quality or the total bitrate.
/// @param live  short frames, for a short delay
/// @return kInvalidArgument for a rate that the codec does not have
[[nodiscard]] Result<SoundSettings> sound_settings(const EncodeArguments& arguments, bool live);

/// The sound's share of a stream, kbit/s: frames, their sizes and packet headers.
[[nodiscard]] double sound_kbps(const SoundSettings& settings);

}  // namespace fbs::cli
