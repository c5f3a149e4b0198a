// Codec 2 (Rowe, Techniques for Harmonic Sinusoidal Coding, 1997, and codec2's source), decoded by libcodec2.
#pragma once

#include <memory>

#include "decoder/sound/sound_decoder.h"

namespace fbs {

/// @return errors of SoundDecoder::create
Result<std::unique_ptr<SoundDecoder>> create_codec2_sound(const SoundSetup& setup);

}  // namespace fbs
