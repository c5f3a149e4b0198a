// The pattern packet: one coded picture and its seen state. SPEC 4.4.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/syntax.h"
#include "common/result.h"

namespace fbs {

/// @param setup  of the scene: parts and steps define which numbers are coded and their limits
/// @return kInvalidArgument  a slot that the setup has not, a negative picture number, a state beyond
/// CodedLimits,
///                           or no AV1 bytes
[[nodiscard]] Result<std::vector<std::uint8_t>> encode_pattern(const PatternSyntax& pattern,
                                                               const Setup& setup);

/// Copies the AV1 bytes without decoding them.
/// @return kTruncated, kTooLarge (slot, picture number), kInvalidStream
[[nodiscard]] Result<PatternSyntax> decode_pattern(std::span<const std::uint8_t> payload, const Setup& setup);

}  // namespace fbs
