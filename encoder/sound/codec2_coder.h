// Codes sound by Codec 2 with libcodec2.
#pragma once

#include <memory>

#include "encoder/sound/sound_encoder.h"

namespace fbs {

/// @return errors of SoundEncoder::create
Result<std::unique_ptr<SoundEncoder>> create_codec2_coder(const SoundSettings& settings);

}  // namespace fbs
