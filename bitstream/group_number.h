// The number of a group's first picture, of which motion and blend packets send the low bits, and what it
// tells. SPEC 4.5.
#pragma once

#include <cstdint>
#include <optional>

#include "bitstream/syntax.h"

namespace fbs {

/// Codes the number of a group's first picture in the scene.
/// @param next  number of the picture behind the last group that was coded
/// @return the number: in next - 256 .. next + 767, below `next` for a group that comes too late
template <class Coder>
std::int32_t code_first(Coder& coder, std::int32_t first, std::int32_t next) {
  constexpr std::int32_t kNumbers = 1 << kNumberBits, kLate = kNumbers / 4;
  const auto low = static_cast<std::int32_t>(
      coder.bypass(kNumberBits, static_cast<std::uint32_t>(first & (kNumbers - 1))));
  const std::int32_t ahead = (low - next) & (kNumbers - 1);
  return next + (ahead < kNumbers - kLate ? ahead : ahead - kNumbers);
}

/// Which groups of one kind a reader of a scene can use.
struct GroupOrder {
  std::int32_t next = 0;  ///< number of the picture behind the last group that was used
  bool needs_key = true;  ///< only a key group can follow

  /// A group begins. If it is used, only a key group can follow until end() is called.
  /// @return pictures that are missing before it; nothing if it is to be skipped
  [[nodiscard]] std::optional<std::int32_t> begin(bool key, std::int32_t first) {
    if (first < next) return std::nullopt;
    if (first > next) needs_key = true;
    if (needs_key && !key) return std::nullopt;
    needs_key = true;
    return first - next;
  }
  /// It has been used.
  /// @param behind  number of the picture behind it
  void end(std::int32_t behind) {
    next = behind;
    needs_key = false;
  }
};

}  // namespace fbs
