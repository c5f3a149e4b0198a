// Opus (RFC 6716) as libopus codes it.
#pragma once

#include <memory>

#include "encoder/sound/sound_encoder.h"

namespace fbs {

/// @return errors as those of SoundEncoder::create
Result<std::unique_ptr<SoundEncoder>> create_opus_coder(const SoundSettings& settings);

}  // namespace fbs
