// How long a stream is, without decoding it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace fbs {

/// By the last setup packet and the end packet. Where the last scene has durations of its own, which only its
/// motion tells, they are taken for those of the frame rate.
/// @param stream  from its signature on
/// @return 1/90000 s; none without an end packet
[[nodiscard]] std::optional<std::uint64_t> stream_length(std::span<const std::uint8_t> stream);

}  // namespace fbs
