// Codes durations of pictures. SPEC 5.5.
#pragma once

#include <cstdint>
#include <utility>

#include "bitstream/entropy/adaptive_integer.h"
#include "bitstream/syntax.h"

namespace fbs {

/// Contexts, named as in SPEC 5.5.
struct DurationContexts {
  AdaptiveBit differs;
  AdaptiveBit differs_from_second;
  WideIntegerContexts change;
};

/// Durations of the last two pictures, 1/90000 s.
struct DurationHistory {
  std::uint32_t last = 0;
  std::uint32_t second_last = 0;
};

/// Codes the duration of one picture, 1..kMaxDuration in 1/90000 s.
/// @param value  is set by a Coder that reads
/// @return false when what was read is out of range
template <class Coder, class Value>
bool code_duration(Coder& coder, DurationContexts& contexts, DurationHistory& history, Value& value) {
  std::uint32_t coded = history.last;
  if (coder.bit(contexts.differs, value != history.last)) {
    coded = history.second_last;
    if (coder.bit(contexts.differs_from_second, value != history.second_last)) {
      const auto change = static_cast<std::int32_t>(value) - static_cast<std::int32_t>(history.last);
      const std::int64_t sum = std::int64_t{history.last} + code_wide_integer(coder, contexts.change, change);
      if (sum < 1 || sum > kMaxDuration) return false;
      coded = static_cast<std::uint32_t>(sum);
    }
  }
  if constexpr (Coder::kReads) value = coded;
  history = {coded, history.last};
  return true;
}

}  // namespace fbs
