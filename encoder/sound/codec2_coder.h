// Codec 2 as libcodec2 codes it.
#pragma once

#include <memory>

#include "encoder/sound/sound_encoder.h"

namespace fbs {

/// @return errors as those of SoundEncoder::create
Result<std::unique_ptr<SoundEncoder>> create_codec2_coder(const SoundSettings& settings);

}  // namespace fbs
