#include "encoder/patterns/pattern_size.h"

#include <cmath>

namespace fbs {
namespace {

/// PSNR gained by twice the bytes, dB: mean slope of the ten clips' curves between 2 and 12 kbit/s.
constexpr double kSlope = 2.2;

/// The face loses more than the mean over the picture, dB.
constexpr double kMargin = 0.3;

/// Share of its patterns' coding errors that a blend keeps after averaging.
constexpr double kErrorLeft = 0.7;

double bytes_of(const PatternCost& cost, std::size_t patterns) {
  return cost.first_bytes + static_cast<double>(patterns - 1) * cost.later_bytes;
}

constexpr int kMostFullSize = 400 * 400;

}  // namespace

bool large_enough_to_reduce(const VideoFormat& format) {
  return format.width * format.height > kMostFullSize;
}

bool reduced_size_pays(double blend_loss, std::size_t patterns, double other_bytes, const PatternCost& full,
                       const PatternCost& reduced) {
  const double loss = 10 * std::log10((blend_loss + kErrorLeft * reduced.squared_error) /
                                      (blend_loss + kErrorLeft * full.squared_error));
  const double saved =
      std::log2((other_bytes + bytes_of(full, patterns)) / (other_bytes + bytes_of(reduced, patterns)));
  return kSlope * saved > loss + kMargin;
}

}  // namespace fbs
