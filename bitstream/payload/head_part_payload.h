// The head part packet: a piece of what a viewer needs who joins a scene. SPEC 4.12.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/syntax.h"
#include "common/result.h"

namespace fbs {

/// @param part  within its limits (assert)
[[nodiscard]] std::vector<std::uint8_t> encode_head_part(const HeadPart& part);

/// @return kTruncated, kTooLarge (head, symbols or pictures beyond their maximum), kInvalidStream
[[nodiscard]] Result<HeadPart> decode_head_part(std::span<const std::uint8_t> payload);

}  // namespace fbs
