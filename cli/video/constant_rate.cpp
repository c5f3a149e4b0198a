#include "cli/video/constant_rate.h"

#include <cmath>
#include <utility>

#include "cli/video/timestamps.h"

namespace fbs {

ConstantRate::Step ConstantRate::next(std::int64_t pts) {
  if (slot_ == 0) first_pts_ = pts;
  const std::int64_t elapsed = pts - first_pts_;
  const std::int64_t late = elapsed - regular_pts(slot_, rate_);
  const std::int64_t tolerance = 3 * regular_pts(1, rate_) / 4;
  Step step;
  if (late < -tolerance) {
    ++change_.dropped;
    return {0, false};
  }
  if (late > tolerance) {
    const double slots = static_cast<double>(elapsed) * rate_.num / (double{kTicksPerSecond} * rate_.den);
    step.repeats = std::llround(slots) - slot_;
    change_.repeated += step.repeats;
  }
  slot_ += step.repeats + 1;
  return step;
}

ConstantRateSink::ConstantRateSink(std::unique_ptr<VideoSink> sink, Rational rate, bool hold)
    : sink_(std::move(sink)), slots_(rate), hold_(hold) {}

Result<void> ConstantRateSink::write(const Picture& picture, std::int64_t pts) {
  const ConstantRate::Step step = slots_.next(pts);
  if (!hold_) return sink_->write(picture, pts);
  for (std::int64_t i = 0; i < step.repeats; ++i)
    if (auto written = sink_->write(last_, pts); !written) return written;
  if (!step.kept) return {};
  last_ = picture;
  return sink_->write(picture, pts);
}

}  // namespace fbs
