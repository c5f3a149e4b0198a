// Times of decoded pictures, which the stream gives as durations.
#pragma once

#include <cstdint>

#include "bitstream/syntax.h"
#include "cli/video/timestamps.h"

namespace fbs::cli {

/// Time of each picture from the durations before it. Those of the frame rate are counted, so that their
/// rounding to 1/90000 s does not add up.
class DecodedTime {
 public:
  DecodedTime() = default;
  explicit DecodedTime(Rational rate) : rate_(rate), nominal_(nominal_duration(rate)) {}

  /// 1/90000 s.
  [[nodiscard]] std::int64_t pts() const { return irregular_ + regular_pts(regular_, rate_); }

  void advance(std::uint32_t duration) {
    if (duration == nominal_ && plausible_rate(rate_))
      ++regular_;
    else
      irregular_ += duration;
  }

 private:
  Rational rate_{25, 1};
  std::uint32_t nominal_ = 0;
  std::int64_t regular_ = 0;    ///< pictures of nominal duration
  std::int64_t irregular_ = 0;  ///< the durations of the others, 1/90000 s
};

}  // namespace fbs::cli
