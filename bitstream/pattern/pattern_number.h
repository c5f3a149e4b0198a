// The number of the picture that a pattern shows, coded by its place among the patterns of the store.
// SPEC 4.4.
//
// AV1 with look-ahead codes the ends of a span of pictures first, then its middle, then the middles of both
// halves: a pattern usually lies half way between two others, near the pattern before it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/entropy/adaptive_integer.h"
#include "bitstream/syntax.h"

namespace fbs {

struct NumberContexts {
  WideIntegerContexts gap;
  WideIntegerContexts from_middle;
  ExponentialContexts from_end;
};

/// The first picture that a pattern may show where `end` pictures have a state.
[[nodiscard]] constexpr std::int32_t first_with_state(std::int32_t end) {
  return std::max(0, end - kMaxWaitingPictures - kKeptPictures);
}

/// Codes the number of a picture.
/// @param store   numbers of the patterns of the store, in any order
/// @param before  number of the pattern coded last
/// @param end     pictures that have a state; not zero
/// @param number  first_with_state(end) .. end - 1 and not zero; set by a Coder that reads
/// @return false when what was read is out of range
template <class Coder>
bool code_number(Coder& coder, NumberContexts& contexts, std::span<const std::int32_t> store,
                 std::int32_t before, std::int32_t end, std::int32_t& number) {
  const std::int32_t first = first_with_state(end);
  std::vector<std::int32_t> bounds = {first};
  for (const std::int32_t n : store) bounds.push_back(std::max(n, first));
  std::sort(bounds.begin(), bounds.end());
  bounds.push_back(end);
  const auto gap_of = [&](std::int32_t n) {  // the last bound not larger than n
    return static_cast<std::int32_t>(std::upper_bound(bounds.begin(), bounds.end() - 1, n) - bounds.begin()) -
           1;
  };
  const std::int32_t from = gap_of(std::max(before, first));
  const std::int32_t gap = from + code_wide_integer(coder, contexts.gap, gap_of(number) - from);
  const auto gaps = static_cast<std::int32_t>(bounds.size()) - 1;
  if (gap < 0 || gap >= gaps) return false;
  const std::int64_t low = bounds[gap], high = bounds[gap + 1];
  const std::int32_t middle = bounds[gap] + (bounds[gap + 1] - bounds[gap]) / 2;
  const std::int64_t read =
      gap + 1 == gaps
          ? high - 1 - std::int64_t{code_exponential(coder, contexts.from_end, end - 1 - number)}
          : std::int64_t{middle} + code_wide_integer(coder, contexts.from_middle, number - middle);
  if (read < std::max<std::int64_t>(low, 1) || read >= high) return false;
  if constexpr (Coder::kReads) number = static_cast<std::int32_t>(read);
  return true;
}

}  // namespace fbs
