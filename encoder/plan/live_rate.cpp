#include "encoder/plan/live_rate.h"

#include <algorithm>
#include <cmath>

namespace fbs {
namespace {

/// Seconds in which a rate twice too high raises the price by e. Shorter ones make quality swing from pattern
/// to pattern.
constexpr double kSettlesIn = 8;

/// Increase in the logarithm of the price from a half full to a full bucket.
constexpr double kFullness = 2;

const double kLimit = std::log(LiveRate::kMaxFactor);

}  // namespace

LiveRate::LiveRate(double kbps, double buffer)
    : bytes_per_second_(125 * kbps), capacity_(bytes_per_second_ * buffer) {}

void LiveRate::set(double kbps) {
  const double factor = 125 * kbps / bytes_per_second_;
  bytes_per_second_ *= factor;
  capacity_ *= factor;
  log_price_ = std::clamp(log_price_ - std::log(factor), -kLimit, kLimit);
}

void LiveRate::add(double bytes, double seconds) {
  const double drained = bytes_per_second_ * seconds;
  waiting_ = std::max(0.0, waiting_ + bytes - drained);
  log_price_ = std::clamp(log_price_ + (bytes - drained) / (bytes_per_second_ * kSettlesIn), -kLimit, kLimit);
}

double LiveRate::price() const {
  const double log_price = log_price_ + kFullness * (waiting_ / capacity_ - 0.5);
  return std::clamp(std::exp(log_price), 1 / kMaxFactor, kMaxFactor);
}

}  // namespace fbs
