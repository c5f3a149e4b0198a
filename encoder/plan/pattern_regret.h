// When a pattern pays for pictures that cannot be seen yet.
#pragma once

#include <algorithm>

namespace fbs {

/// A pattern is bought once the pictures since the last one have lost what it costs, as skis are bought once
/// their rent has come to the price (Karlin et al., Competitive snoopy caching, 1988). Whatever comes next,
/// the cost is at most twice that of knowing it.
class PatternRegret {
 public:
  /// A pattern has come.
  /// @param error  of its own picture, drawn from it: squared luma levels, sum over the picture
  void begin(double error) {
    least_ = error;
    lost_ = 0;
  }

  /// The next picture.
  /// @param error  in its cheapest modes
  void add(double error) { lost_ += std::max(0.0, error - least_); }

  /// @param bits    that the pattern takes
  /// @param lambda  squared luma levels that a bit is worth
  [[nodiscard]] bool pays(double bits, double lambda) const { return lost_ > lambda * bits; }

 private:
  double least_ = 0;
  double lost_ = 0;
};

}  // namespace fbs
