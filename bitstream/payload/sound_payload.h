// The sound setup packet and the sound packet. SPEC 4.9, 4.10.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bitstream/sound_syntax.h"
#include "bitstream/syntax.h"
#include "common/result.h"

namespace fbs {

/// Bytes; Opus' own limit is 1275 for each of its streams.
inline constexpr std::size_t kMaxSoundFrame = 1500;
/// All frames of a packet begin within this time, 1/kSoundClock s.
inline constexpr std::int32_t kMaxSoundGroup = kSoundClock;

[[nodiscard]] constexpr bool is_sound(PacketType type) {
  return type == PacketType::kSoundSetup || type == PacketType::kSound;
}

/// Whether a decoder of this format accepts it: the rules of SoundSetup's comments and SPEC 4.9.
[[nodiscard]] bool is_valid(const SoundSetup& setup);

/// @return kInvalidArgument  not is_valid()
[[nodiscard]] Result<std::vector<std::uint8_t>> encode_sound_setup(const SoundSetup& setup);

/// Bytes after the known fields are ignored.
/// @return nullopt for a codec or a mode of Codec 2 that this version does not know: the sound is left out;
///         kTruncated, kInvalidStream
[[nodiscard]] Result<std::optional<SoundSetup>> decode_sound_setup(std::span<const std::uint8_t> payload);

/// @return kInvalidArgument  no frame, frames over more than kMaxSoundGroup, a number or a frame out of
///                           range, or a Codec 2 frame of another length
[[nodiscard]] Result<std::vector<std::uint8_t>> encode_sound(const SoundGroup& group,
                                                             const SoundSetup& setup);

/// @return kTruncated, kTooLarge (frame, or frames over more than kMaxSoundGroup), kInvalidStream
[[nodiscard]] Result<SoundGroup> decode_sound(std::span<const std::uint8_t> payload, const SoundSetup& setup);

}  // namespace fbs
