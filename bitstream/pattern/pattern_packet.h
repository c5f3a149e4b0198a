// Pattern packets: coded pictures, and where in the scene they were seen. SPEC 4.4.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/pattern/pattern_syntax.h"
#include "common/result.h"

namespace fbs {

/// Limit for several patterns in one packet, all of which are lost if one bit of it is wrong.
inline constexpr std::size_t kMaxPatternsTogether = std::size_t{1} << 19;

/// Writes the pattern packets of one scene, in stream order. A value: a copy continues independently.
class PatternPacketWriter {
 public:
  /// Codes the next packet.
  /// @param patterns  1..kMaxPatterns; the first of the scene, and one that is `alone`, by itself
  /// @param setup     of the scene: parts and steps define which numbers are coded and their limits
  /// @param pictures  of the scene that have a state
  /// @return kInvalidArgument  another number of patterns, a slot that the setup does not have, a picture
  ///                           without a state or whose state is not kept, a state beyond CodedLimits, no AV1
  ///                           bytes, a payload beyond kMaxPayload. The writer is then unchanged.
  [[nodiscard]] Result<std::vector<std::uint8_t>> encode(std::span<const PatternSyntax> patterns,
                                                         const Setup& setup, std::int32_t pictures);

 private:
  PatternMemory memory_;
};

/// The packet of a scene's first pattern, as a new PatternPacketWriter codes it.
/// @param pattern  slot 0, picture 0
/// @return kInvalidArgument  another slot or picture, a state beyond CodedLimits, no AV1 bytes, a payload
///                           beyond kMaxPayload
[[nodiscard]] Result<std::vector<std::uint8_t>> encode_first_pattern(const PatternSyntax& pattern,
                                                                     const Setup& setup);

/// Reads the pattern packets of one scene. Some may be missing.
class PatternPacketReader {
 public:
  /// Reads the next packet; copies the AV1 bytes without decoding them. After an error or a missing packet
  /// only a scene's first pattern and patterns that are `alone` can be read.
  /// @param pictures  of the scene that have a state
  /// @return nothing if the patterns need one that is missing; kTruncated, kTooLarge (slot, number of
  /// patterns),
  ///         kInvalidStream
  [[nodiscard]] Result<std::vector<PatternSyntax>> decode(std::span<const std::uint8_t> payload,
                                                          const Setup& setup, std::int32_t pictures);

  /// A pattern in the chain is missing.
  void lose() { broken_ = true; }
  /// Whether one is known to be missing.
  [[nodiscard]] bool is_broken() const { return broken_; }

 private:
  [[nodiscard]] static Result<std::vector<PatternSyntax>> read(RangeDecoder& decoder, const Setup& setup,
                                                               std::int32_t pictures, bool first, bool alone,
                                                               PatternMemory& memory);

  PatternMemory memory_;
  bool needs_first_ = true;
  bool broken_ = false;  // the chain of patterns
};

}  // namespace fbs
