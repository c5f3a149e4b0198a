// Opus (RFC 6716), decoded by libopus at 48 kHz.
#pragma once

#include <memory>

#include "decoder/sound/sound_decoder.h"

namespace fbs {

/// The shortest Opus frame and the longest packet, samples at 48 kHz: 2.5 and 120 ms.
inline constexpr std::int32_t kMinOpusDuration = 120, kMaxOpusDuration = 5760;

/// @return errors of SoundDecoder::create
Result<std::unique_ptr<SoundDecoder>> create_opus_sound(const SoundSetup& setup);

}  // namespace fbs
