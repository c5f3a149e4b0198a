// The length of a stream, without decoding it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace fbs {

/// From the last setup packet and the end packet. Where the last scene has its own durations, which only its
/// motion gives, the frame rate's are assumed.
/// @param stream  from its signature on
/// @return 1/90000 s; none without an end packet
[[nodiscard]] std::optional<std::uint64_t> stream_length(std::span<const std::uint8_t> stream);

}  // namespace fbs
