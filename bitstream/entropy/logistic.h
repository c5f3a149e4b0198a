// Logarithm and logistic function to base two, on integers, for mixing probabilities and for counting bits.
// The results are part of the format. SPEC 2.5.
#pragma once

#include <cstdint>

namespace fbs {

/// -log2(probability / 65536) in 1/65536 bit, exact to about 1e-5 bit.
/// @param probability  1..65536
[[nodiscard]] std::uint32_t cost_of(std::uint32_t probability);

/// log2(p / (1 - p)) in 1/65536 for p = probability / 65536.
/// @param probability  1..65535
/// @return about +-16 * 65536
[[nodiscard]] std::int32_t stretch(std::uint32_t probability);

/// The inverse of stretch: the probability whose log-odds to base two are `log_odds` / 65536.
/// @return 1/65536; kMinProbability .. kProbabilityOne - kMinProbability
[[nodiscard]] std::uint32_t squash(std::int32_t log_odds);

}  // namespace fbs
