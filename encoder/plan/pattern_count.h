// How many patterns, and of which size: by total rate-distortion cost.
#pragma once

#include <cstddef>
#include <span>

namespace fbs {

/// Luma error that pictures have between patterns without coding loss, measured at a number of patterns.
struct BlendLoss {
  std::size_t patterns;
  double squared_error;  ///< mean over samples
};

/// What patterns of one kind cost.
struct PatternRate {
  double first_bytes, later_bytes;
  double squared_error;  ///< of the coding, mean over luma samples
};

struct PatternCount {
  std::size_t patterns;
  double cost;  ///< squared luma error of all pictures, plus lambda times bits
};

/// The number of patterns with the smallest cost.
/// @param losses   at two numbers of patterns or more, rising; the error between follows a power law
/// @param rate     at `rate_count` patterns
/// @param samples  luma samples of all pictures
/// @param lambda   squared luma levels that a bit is worth
[[nodiscard]] PatternCount best_count(std::span<const BlendLoss> losses, const PatternRate& rate,
                                      std::size_t rate_count, double samples, double lambda, std::size_t max_count);

}  // namespace fbs
