// Writes pictures with their own times at a constant rate: holds or drops pictures to keep the speed.
#pragma once

#include <cstdint>
#include <memory>

#include "cli/video/video_sink.h"

namespace fbs {

/// Effect of a constant rate, in pictures.
struct RateChange {
  std::int64_t repeated = 0;
  std::int64_t dropped = 0;
  [[nodiscard]] bool any() const { return repeated > 0 || dropped > 0; }
};

/// Assigns pictures to the slots of a constant rate. A picture takes the next free slot while that is less
/// than 3/4 of a period from its time, so that jitter changes nothing. A later picture takes the nearest
/// slot, and the slots before it repeat the previous picture; an earlier one is dropped.
class ConstantRate {
 public:
  /// @param rate  slots per second, a plausible_rate
  explicit ConstantRate(Rational rate) : rate_(rate) {}

  struct Step {
    std::int64_t repeats = 0;  ///< slots first filled by the previous picture
    bool kept = true;          ///< whether the picture itself has a slot
  };

  /// @param pts  1/90000 s, rising; the first picture has slot 0 whatever its time
  Step next(std::int64_t pts);

  [[nodiscard]] const RateChange& change() const { return change_; }

 private:
  Rational rate_;
  std::int64_t first_pts_ = 0;
  std::int64_t slot_ = 0;  ///< the next free one
  RateChange change_;
};

/// Writes into a sink without timestamps. The last picture is written once: its duration is unknown.
class ConstantRateSink final : public VideoSink {
 public:
  /// @param hold  false: each picture is written once, and change() gives the effect on the times
  ConstantRateSink(std::unique_ptr<VideoSink> sink, Rational rate, bool hold);

  Result<void> write(const Picture& picture, std::int64_t pts) override;
  [[nodiscard]] bool replaced_leftover() const override { return sink_->replaced_leftover(); }
  Result<void> finish() override { return sink_->finish(); }

  /// Pictures so far that were repeated and dropped, or would have been without `hold`.
  [[nodiscard]] const RateChange& change() const { return slots_.change(); }

 private:
  std::unique_ptr<VideoSink> sink_;
  ConstantRate slots_;
  bool hold_;
  Picture last_;  ///< in the slot before the next free one
};

}  // namespace fbs
