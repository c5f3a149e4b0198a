// Rates in kilobits a second: which quality fits one, and what each group of motion may take.
#pragma once

#include <cstdint>
#include <functional>

namespace fbs {

/// The highest quality at which startup and the motion that goes with it fit a total rate; 0 when none does.
/// @param kbps     total rate
/// @param seconds  over which the startup is spread, > 0
/// @param startup  bytes before the first picture at a quality of 0..100; called some seven times
[[nodiscard]] int quality_for(double kbps, double seconds, const std::function<std::size_t(int)>& startup);

/// Spreads a rate over groups: what one leaves or takes too much, the next ones make up for.
class RateBudget {
 public:
  /// @param kbps  of the motion, > 0
  explicit RateBudget(double kbps) : bits_per_second_(1000 * kbps) {}

  /// Bits that the next group may take.
  [[nodiscard]] double allowed(double seconds) const;
  void spend(double bits, double seconds);

 private:
  double bits_per_second_;
  double left_ = 0;  ///< bits not yet taken; negative: too many
};

/// The lambda at which a group takes what it may.
/// @param lambda  of the group before
/// @param rest    of the scene, which bounds what comes out: 1/64 .. 4096 of it
/// @param bits    of the group at a lambda; falls with it; called some eight times
[[nodiscard]] double lambda_for(double allowed, double lambda, double rest,
                                const std::function<double(double)>& bits);

}  // namespace fbs
