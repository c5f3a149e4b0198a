// Rates in kilobits per second: chooses the operating point for a target, and the share of each group of
// motion.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>

#include "common/result.h"
#include "encoder/plan/operating_point.h"

namespace fbs {

/// The requested rate or quality.
struct RateTarget {
  int quality = 50;            ///< 0..100; where no bitrate is set
  double bitrate_kbps = 0;     ///< total; 0: quality decides
  double seconds = 0;          ///< length of the video; 0: unknown
  double motion_kbps = 0;      ///< of motion alone, where no bitrate is set; 0: quality decides
  double eye_distance_px = 0;  ///< in the scene's first picture
};

struct RatePlan {
  OperatingPoint point;
  double motion_kbps = 0;  ///< limit for groups; 0: lambda alone decides
};

/// Bytes of the first pattern at a quantiser of 0..63.
using PatternBytes = std::function<Result<std::size_t>(int quantiser)>;

/// @param other_bytes  of the startup besides the pattern
/// @return errors of pattern_bytes
[[nodiscard]] Result<RatePlan> plan_rate(const RateTarget& target, std::size_t other_bytes,
                                         const PatternBytes& pattern_bytes);

/// The highest quality at which the startup and its motion fit a total rate; 0 when none does.
/// @param kbps     total rate
/// @param seconds  over which the startup is spread, > 0
/// @param startup  bytes before the first picture at a quality of 0..100; called at most 7 times
/// @return errors of startup
[[nodiscard]] Result<int> quality_for(double kbps, double seconds,
                                      const std::function<Result<std::size_t>(int)>& startup);

/// Spreads a rate over groups: later groups compensate for what earlier ones saved or overspent.
class RateBudget {
 public:
  /// @param kbps  of the motion, > 0
  explicit RateBudget(double kbps) : bits_per_second_(1000 * kbps) {}

  /// Bits that the next group may take.
  [[nodiscard]] double allowed(double seconds) const;
  void spend(double bits, double seconds);

 private:
  double bits_per_second_;
  double left_ = 0;  ///< bits not yet spent; negative: overspent
};

/// The plan whose bits come closest to the allowed number, by bisection over the logarithm of lambda; prefers
/// too few bits to too many.
/// @param lambda  to start from: the previous group's
/// @param base    the scene's, which limits the search to base / 64 .. 4096 base
/// @param plan    takes a lambda, returns a value with a member `bits` that falls with lambda; called at most
///                10 times
template <class Plan>
[[nodiscard]] auto plan_within(double allowed_bits, double lambda, double base, Plan&& plan) {
  constexpr double kTolerance = 0.03;  // of the allowed bits, below them
  constexpr int kMaxTrials = 9;
  const double min = base / 64, max = base * 4096;
  double too_many = 0, few_enough = 0;  // lambdas; 0: unknown
  std::optional<decltype(plan(lambda))> best;
  for (int trial = 0; trial < kMaxTrials; ++trial) {
    auto planned = plan(lambda);
    const bool over = planned.bits > allowed_bits;
    if (!over && planned.bits >= (1 - kTolerance) * allowed_bits) return planned;
    if (over) {
      too_many = lambda;
    } else {
      few_enough = lambda;
      best = planned;
    }
    if (too_many > 0 && few_enough > 0) {
      lambda = std::sqrt(too_many * few_enough);
    } else {
      const double next = std::clamp(over ? lambda * 4 : lambda / 4, min, max);
      if (next == lambda) return planned;
      lambda = next;
    }
  }
  return best ? *std::move(best) : plan(lambda);
}

}  // namespace fbs
