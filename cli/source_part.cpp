#include "cli/source_part.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fbs::cli {

SourcePart::SourcePart(std::unique_ptr<VideoSource> source, const PartLimits& limits, const StopSignal& stop)
    : source_(std::move(source)), limits_(limits), stop_(stop) {}

Result<std::optional<TimedPicture>> SourcePart::next() {
  ended_ = ended_ || stop_.raised() || (limits_.pictures && pictures_ >= *limits_.pictures);
  if (ended_) return std::nullopt;
  auto picture = source_->next();
  // A read that the signal interrupted fails. What it had read of a picture is lost.
  if (!picture && stop_.raised()) picture = std::nullopt;
  ended_ = !picture || !*picture || !within_seconds((*picture)->pts);
  if (ended_) return picture ? std::nullopt : std::move(picture);
  ++pictures_;
  return picture;
}

bool SourcePart::within_seconds(std::int64_t pts) {
  if (!first_pts_) first_pts_ = pts;
  if (!limits_.seconds) return true;
  return static_cast<double>(pts - *first_pts_) < *limits_.seconds * kTicksPerSecond;
}

std::optional<std::int64_t> SourcePart::frame_count_estimate() const {
  auto estimate = source_->frame_count_estimate();
  const auto limit = [&](std::int64_t pictures) {
    estimate = estimate ? std::min(*estimate, pictures) : pictures;
  };
  if (limits_.pictures) limit(*limits_.pictures);
  const Rational rate = format().frame_rate;
  if (limits_.seconds) limit(std::llround(std::ceil(*limits_.seconds * rate.num / rate.den)));
  return estimate;
}

}  // namespace fbs::cli
