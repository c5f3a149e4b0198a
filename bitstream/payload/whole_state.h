// Codes a state without reference to another: the seen state of a pattern. SPEC 5.3.
#pragma once

#include <array>

#include "bitstream/coded_state.h"
#include "bitstream/entropy/adaptive_integer.h"

namespace fbs {

/// For rotations, shifts, the log scale, and all other numbers.
using WholeStateContexts = std::array<WideIntegerContexts, 4>;

/// @return false when what was read is out of range
template <class Coder>
bool code_whole_state(Coder& coder, const CodedLimits& limits, CodedState& state) {
  WholeStateContexts contexts;
  bool in_range = true;
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    if (!has_part(limits.parts, kPartOf[i])) {
      state[i] = 0;
      continue;
    }
    const std::size_t kind = i <= kRoll ? 0 : i <= kShiftY ? 1 : i == kLogScale ? 2 : 3;
    state[i] = code_wide_integer(coder, contexts[kind], state[i]);
    in_range = in_range && limits.hold(i, state[i]);
  }
  return in_range;
}

}  // namespace fbs
