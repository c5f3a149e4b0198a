// The number of a group's first picture, of which motion and blend packets send the low bits. SPEC 4.5.
#pragma once

#include <cstdint>

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

}  // namespace fbs
