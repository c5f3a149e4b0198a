// Codes sound by Opus (RFC 6716) with libopus.
#pragma once

#include <memory>

#include "encoder/sound/sound_encoder.h"

namespace fbs {

/// @return errors of SoundEncoder::create
Result<std::unique_ptr<SoundEncoder>> create_opus_coder(const SoundSettings& settings);

}  // namespace fbs
