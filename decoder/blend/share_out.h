// Rounds shares so that they sum to the whole. SPEC 11.4, 11.5. Integers only.
#pragma once

#include <cstdint>
#include <span>

namespace fbs {

/// Shares of `whole` in proportion to parts, rounded; the first of the largest takes the rounding error.
/// @param part  gives part k, not negative; called before out[k] is written
/// @param sum   of the parts, not zero
template <class Part>
void share_out(Part&& part, std::int64_t sum, std::int32_t whole, std::span<std::int32_t> out) {
  std::int32_t left = whole;
  std::size_t largest = 0;
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k] = static_cast<std::int32_t>((part(k) * whole + sum / 2) / sum);
    left -= out[k];
    if (out[k] > out[largest]) largest = k;
  }
  out[largest] += left;
}

}  // namespace fbs
