// A value that is linear along a run of samples.
#pragma once

#include <cstdint>

namespace fbs {

struct LinearRow {
  std::int64_t first;  ///< at the first sample
  std::int64_t step;   ///< per sample
  [[nodiscard]] std::int64_t at(std::int64_t sample) const { return first + sample * step; }
  /// The same run from a later sample on.
  [[nodiscard]] LinearRow from(std::int64_t sample) const { return {at(sample), step}; }
};

}  // namespace fbs
