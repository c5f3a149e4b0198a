// The layout of a pattern packet, described once for writing and reading. SPEC 4.4.
//
// Coder is RangeEncoder or RangeDecoder; Pattern is PatternSyntax for the one that reads and
// const PatternSyntax for the other.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "bitstream/entropy/range_coder.h"
#include "bitstream/packet.h"
#include "bitstream/pattern/frame_bits.h"
#include "bitstream/pattern/pattern_number.h"
#include "bitstream/syntax.h"

namespace fbs {

/// What adapts from pattern to pattern of a scene.
struct PatternMemory {
  AdaptiveBit other_slot;
  NumberContexts number;
  AdaptiveBit has_length;
  AdaptiveBit has_next;
  ExponentialContexts length;
  FrameContexts frame = initial_frame_contexts();

  std::array<std::int32_t, kMaxPatterns> store{};  ///< picture of the pattern in each slot
  std::int32_t stored = 0;                         ///< slots that are not empty
  std::int32_t slot = -1, picture = 0;             ///< of the last pattern
  std::int32_t packets = 0;                        ///< before the next one, those of patterns alone left out

  void add(const PatternSyntax& pattern) {
    slot = pattern.slot;
    picture = pattern.picture;
    store[slot] = picture;
    stored = std::max(stored, slot + 1);
  }
};

/// The modulus divides no usual number of pictures of groups that may be missing.
inline constexpr int kPacketBits = 4, kPicturesBits = 6, kPicturesModulus = 61, kAlonePictureBits = 13;

/// Codes what tells whether all has come that a packet in the chain of patterns needs.
/// @param pictures  that have a state
/// @return whether it has
template <class Coder>
bool code_chain(Coder& coder, const PatternMemory& memory, std::int32_t pictures) {
  constexpr std::uint32_t kPackets = (1u << kPacketBits) - 1;
  const std::uint32_t packets = static_cast<std::uint32_t>(memory.packets) & kPackets;
  const auto now = static_cast<std::uint32_t>(pictures % kPicturesModulus);
  const bool same_packets = coder.bypass(kPacketBits, packets) == packets;
  return coder.bypass(kPicturesBits, now) == now && same_packets;
}

/// Codes slot and picture of a pattern that needs the first alone.
/// @param pictures  that have a state
template <class Coder, class Pattern>
void code_place_alone(Coder& coder, std::int32_t pictures, Pattern& pattern) {
  constexpr std::int32_t kNumbers = 1 << kAlonePictureBits, kAhead = kNumbers / 4;
  const auto slot = static_cast<std::int32_t>(coder.bypass(6, static_cast<std::uint32_t>(pattern.slot)));
  const auto low = static_cast<std::int32_t>(
      coder.bypass(kAlonePictureBits, static_cast<std::uint32_t>(pattern.picture & (kNumbers - 1))));
  if constexpr (Coder::kReads) {
    const std::int32_t last = pictures + kAhead;
    pattern.slot = slot;
    pattern.picture = last - ((last - low) & (kNumbers - 1));
  }
}

/// Codes slot and picture of a pattern in the chain that is not the first.
/// @param pictures  that have a state; not zero
/// @return false when what was read is out of range
template <class Coder, class Pattern>
bool code_place(Coder& coder, PatternMemory& memory, std::int32_t pictures, Pattern& pattern) {
  static_assert(kMaxPatterns == 1 << 6);
  std::int32_t slot = memory.slot + 1, picture = pattern.picture;
  if (coder.bit(memory.other_slot, pattern.slot != slot))
    slot = static_cast<std::int32_t>(coder.bypass(6, static_cast<std::uint32_t>(pattern.slot)));
  const std::span<const std::int32_t> store(memory.store.data(), memory.stored);
  if (!code_number(coder, memory.number, store, memory.picture, pictures, picture)) return false;
  if constexpr (Coder::kReads) {
    pattern.slot = slot;
    pattern.picture = picture;
  }
  return true;
}

/// Codes a frame whose length is sent.
/// @return false when what is read ends early
template <class Coder, class Pattern>
bool code_frame(Coder& coder, PatternMemory& memory, Pattern& pattern) {
  static_assert(kMaxPayload - 2 <= kMaxExponential);
  const auto coded = static_cast<std::uint32_t>(pattern.av1.size());
  const std::size_t length = code_exponential(coder, memory.length, coded - 1) + 1;
  FramePlace place;
  for (std::size_t i = 0; i < length; ++i) {
    if constexpr (Coder::kReads) {
      if (!coder.ok()) return false;
      pattern.av1.push_back(code_frame_byte(coder, memory.frame, place, 0));
    } else {
      code_frame_byte(coder, memory.frame, place, pattern.av1[i]);
    }
  }
  return true;
}

/// Writes a frame that the end of the code ends.
/// @return false when the end would fall elsewhere
inline bool write_open_frame(RangeEncoder& coder, PatternMemory& memory, const PatternSyntax& pattern) {
  FramePlace place;
  std::size_t written = 0;
  for (const std::uint8_t byte : pattern.av1) {
    written = coder.written();
    code_frame_byte(coder, memory.frame, place, byte);
  }
  return pattern.av1.size() == 1 || coder.written() > written;
}

inline void read_open_frame(RangeDecoder& coder, PatternMemory& memory, PatternSyntax& pattern) {
  FramePlace place;
  do {
    pattern.av1.push_back(code_frame_byte(coder, memory.frame, place, 0));
  } while (!coder.past_open_end());
}

}  // namespace fbs
