// Times of decoded pictures, which the stream gives as durations.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "bitstream/syntax.h"
#include "cli/video/timestamps.h"

namespace fbs::cli {

/// Time of each picture from the durations before it. Counts durations of the frame rate, so that their
/// rounding to 1/90000 s does not add up. From time to time an encoder makes up for the rounding by a
/// duration that is longer or shorter: it leads back to the counted time, and counts as another of the frame
/// rate.
class DecodedTime {
 public:
  DecodedTime() = default;
  explicit DecodedTime(Rational rate) : rate_(rate), nominal_(nominal_duration(rate)) {}

  /// 1/90000 s.
  [[nodiscard]] std::int64_t pts() const { return irregular_ + regular_pts(regular_, rate_); }

  void advance(std::uint32_t duration) {
    stream_ += duration;
    const std::int64_t now = pts(), next = irregular_ + regular_pts(regular_ + 1, rate_);
    const bool leads_back = std::abs(stream_ - next) <= kRounding;
    if (plausible_rate(rate_) && (duration == nominal_ || leads_back))
      ++regular_;
    else
      irregular_ += std::max(stream_ - now, std::int64_t{1});
  }

 private:
  static constexpr std::int64_t kRounding = 2;  ///< in the times of two pictures of the source

  Rational rate_{25, 1};
  std::uint32_t nominal_ = 0;
  std::int64_t stream_ = 0;     ///< sum of the durations
  std::int64_t regular_ = 0;    ///< pictures of nominal duration
  std::int64_t irregular_ = 0;  ///< what the other pictures add, 1/90000 s
};

}  // namespace fbs::cli
