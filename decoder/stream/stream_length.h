// The length of a stream, without decoding it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace fbs {

/// From the last setup packet, a return packet behind it, and the end packet. Where pictures behind these
/// have their own durations, which only motion gives, those of the frame rate are assumed.
/// @param stream  from its signature on
/// @return 1/90000 s; none without an end packet
[[nodiscard]] std::optional<std::uint64_t> stream_length(std::span<const std::uint8_t> stream);

}  // namespace fbs
