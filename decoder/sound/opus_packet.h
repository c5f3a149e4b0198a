// What an Opus packet says about itself.
#pragma once

#include <cstdint>
#include <span>

namespace fbs {

/// Duration of an Opus packet, 1/kSoundClock s; 0 if it is invalid.
[[nodiscard]] std::int32_t opus_duration(std::span<const std::uint8_t> packet);

}  // namespace fbs
