// The return packet: goes on with a scene that is kept. SPEC 4.13.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/syntax.h"
#include "common/result.h"

namespace fbs {

[[nodiscard]] std::vector<std::uint8_t> encode_return(const Return& to);

/// Bytes after the known fields are ignored.
/// @return kTruncated, kInvalidStream, or kTooLarge beyond kMaxStreamPictures, kMaxStreamTime or
///         kMaxPictureNumber
[[nodiscard]] Result<Return> decode_return(std::span<const std::uint8_t> payload);

}  // namespace fbs
