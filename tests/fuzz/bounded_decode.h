// Decodes any bytes as a stream, checks the invariants of every stream, and does a bounded amount of work.
#pragma once

#include <cstdint>
#include <span>

namespace fbs::fuzz {

inline constexpr int kMaxDrawnSide = 160;     ///< pixels; small pictures find the same bugs sooner
inline constexpr int kMaxDrawnPictures = 60;  ///< the rest of the stream is not decoded

/// The result of decoding.
struct DecodeTally {
  std::uint64_t drawn = 0;   ///< pictures
  std::uint64_t held = 0;    ///< of those, or after them
  std::uint64_t errors = 0;  ///< reported by the decoder
};

/// Aborts where an invariant is broken.
DecodeTally decode_bounded(std::span<const std::uint8_t> stream);

}  // namespace fbs::fuzz
