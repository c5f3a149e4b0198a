#include "encoder/plan/live_rate.h"

#include <algorithm>

namespace fbs {
namespace {

/// Share of the bucket that should wait: enough that the channel is not idle between two patterns. More of it
/// would only add to the delay.
constexpr double kWaits = 0.2;

/// By how much of the channel's rate the target falls from an empty to a full bucket. With 2 it swings with
/// each pattern, and the quantiser with it (-.2 dB in the face).
constexpr double kGain = 1.5;

/// s in which a bucket that is empty, less kWaits, raises the target by the channel's rate: plans that always
/// take more or less than they say are corrected.
constexpr double kSettlesIn = 4;
constexpr double kMostCorrection = 0.6;

}  // namespace

LiveRate::LiveRate(double kbps, double buffer)
    : bytes_per_second_(125 * kbps), capacity_(bytes_per_second_ * buffer) {}

void LiveRate::set(double kbps) {
  const double factor = 125 * kbps / bytes_per_second_;
  bytes_per_second_ *= factor;
  capacity_ *= factor;
}

void LiveRate::add(double bytes, double seconds) {
  waiting_ = std::max(0.0, waiting_ + bytes - bytes_per_second_ * seconds);
  correction_ += (kWaits - waiting_ / capacity_) * seconds / kSettlesIn;
  correction_ = std::clamp(correction_, -kMostCorrection, kMostCorrection);
}

double LiveRate::target() const {
  return 8 * bytes_per_second_ * (1 + correction_ + kGain * (kWaits - waiting_ / capacity_));
}

}  // namespace fbs
