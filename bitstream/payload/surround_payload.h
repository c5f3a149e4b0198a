// The surround packet: what the picture round the face moves with. SPEC 4.3.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/syntax.h"
#include "common/result.h"

namespace fbs {

/// @return kInvalidArgument  columns or rows outside 1..kMaxSurroundCells, layers not of (columns + 1) *
/// (rows + 1)
///                           values, a value beyond kFollowOne, or one of the body where the head's is that
[[nodiscard]] Result<std::vector<std::uint8_t>> encode_surround(const SurroundMap& map);

/// @return kTruncated, kTooLarge (columns or rows beyond kMaxSurroundCells), kInvalidStream
[[nodiscard]] Result<SurroundMap> decode_surround(std::span<const std::uint8_t> payload);

}  // namespace fbs
