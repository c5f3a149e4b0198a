// The surround packet: the motion that each point around the face follows. SPEC 4.3.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/syntax.h"
#include "common/result.h"

namespace fbs {

/// @return kInvalidArgument  columns or rows outside 1..kMaxSurroundCells; a layer without exactly
///                           (columns + 1) * (rows + 1) values; a value beyond kFollowOne; a value of the
///                           body other than 0 where the head's is kFollowOne
[[nodiscard]] Result<std::vector<std::uint8_t>> encode_surround(const SurroundMap& map);

/// @return kTruncated, kTooLarge (columns or rows beyond kMaxSurroundCells), kInvalidStream
[[nodiscard]] Result<SurroundMap> decode_surround(std::span<const std::uint8_t> payload);

}  // namespace fbs
