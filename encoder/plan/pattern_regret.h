// Decides when a pattern pays although later pictures are unknown.
#pragma once

#include <algorithm>

namespace fbs {

/// A pattern is bought once the pictures since the last one have lost what it costs, as skis are bought once
/// their rent has reached the price (Karlin et al., Competitive snoopy caching, 1988). Whatever follows, the
/// cost is at most twice the optimum in hindsight.
class PatternRegret {
 public:
  /// Starts a new pattern.
  /// @param error  of its own picture, drawn from it: squared luma levels, sum over the picture
  void begin(double error) {
    least_ = error;
    lost_ = 0;
  }

  /// Adds the next picture.
  /// @param error  in its cheapest modes
  void add(double error) { lost_ += std::max(0.0, error - least_); }

  /// @param bits    the pattern's size
  /// @param lambda  squared luma levels that a bit is worth
  [[nodiscard]] bool pays(double bits, double lambda) const { return lost_ > lambda * bits; }

 private:
  double least_ = 0;
  double lost_ = 0;
};

}  // namespace fbs
