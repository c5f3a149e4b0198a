#include "encoder/plan/rate_control.h"

#include <algorithm>
#include <cmath>

namespace fbs {
namespace {

constexpr double kSecondsUnknown = 10;  // over which the startup is spread when the length is unknown
constexpr double kMinMotion = 0.15;     // share of the total rate, whatever the startup takes

double kbps_of(std::size_t bytes, double seconds) {
  return 8e-3 * static_cast<double>(bytes) / seconds;
}

/// Approximate rate of motion at a quality; measured on the ten clips with the tracks of format 3.
double usual_motion_kbps(int quality) {
  return 1.0 * std::exp2((quality - 50) / 30.0);
}

}  // namespace

Result<RatePlan> plan_rate(const RateTarget& target, std::size_t other_bytes,
                           const PatternBytes& pattern_bytes) {
  const auto plan_at = [&](int quality, double motion_kbps) {
    return RatePlan{OperatingPoint::at(quality, target.eye_distance_px), motion_kbps};
  };
  if (target.bitrate_kbps <= 0) return plan_at(target.quality, target.motion_kbps);
  const double seconds = target.seconds > 0 ? target.seconds : kSecondsUnknown;
  const auto startup = [&](int quality) -> Result<std::size_t> {
    const auto pattern = pattern_bytes(OperatingPoint::at(quality, target.eye_distance_px).pattern_quantiser);
    if (!pattern) return fail(pattern.error());
    return other_bytes + *pattern;
  };
  const auto quality = quality_for(target.bitrate_kbps, seconds, startup);
  if (!quality) return fail(quality.error());
  const auto bytes = startup(*quality);
  if (!bytes) return fail(bytes.error());
  return plan_at(*quality,
                 std::max(target.bitrate_kbps - kbps_of(*bytes, seconds), kMinMotion * target.bitrate_kbps));
}

Result<int> quality_for(double kbps, double seconds, const std::function<Result<std::size_t>(int)>& startup) {
  int low = 0, high = 101;  // the highest that fits, and the lowest that does not
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    const auto bytes = startup(middle);
    if (!bytes) return fail(bytes.error());
    (kbps_of(*bytes, seconds) + usual_motion_kbps(middle) <= kbps ? low : high) = middle;
  }
  return low;
}

double RateBudget::allowed(double seconds) const {
  const double even = bits_per_second_ * seconds;
  return std::max(0.25 * even, even + 0.5 * left_);
}

void RateBudget::spend(double bits, double seconds) {
  left_ += bits_per_second_ * seconds - bits;
}

}  // namespace fbs
