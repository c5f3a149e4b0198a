// The pattern packet: one coded picture and the state in which it was seen. SPEC 4.4.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/syntax.h"
#include "common/result.h"

namespace fbs {

/// @param setup  of the scene: its parts say which numbers are coded, its steps bound them
/// @return kInvalidArgument  index outside 0..kMaxPatterns-1, a state beyond CodedLimits, or no AV1 bytes
[[nodiscard]] Result<std::vector<std::uint8_t>> encode_pattern(const PatternSyntax& pattern,
                                                               const Setup& setup);

/// The AV1 bytes are copied and not looked at.
/// @return kTruncated, kTooLarge (index), kInvalidStream
[[nodiscard]] Result<PatternSyntax> decode_pattern(std::span<const std::uint8_t> payload, const Setup& setup);

}  // namespace fbs
