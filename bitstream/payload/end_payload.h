// The end packet of a complete stream. SPEC 4.7.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/syntax.h"
#include "common/result.h"

namespace fbs {

[[nodiscard]] std::vector<std::uint8_t> encode_end(const End& end);

/// Bytes after the known fields are ignored.
/// @return kTruncated, kInvalidStream, or kTooLarge beyond kMaxStreamPictures
[[nodiscard]] Result<End> decode_end(std::span<const std::uint8_t> payload);

}  // namespace fbs
