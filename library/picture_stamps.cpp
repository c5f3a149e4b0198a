#include "library/picture_stamps.h"

#include <algorithm>
#include <utility>

namespace fbs {
namespace {

/// Times of a clock are within +- this, so that differences do not overflow.
constexpr std::int64_t kMaxTime = std::int64_t{1} << 61;

}  // namespace

const char* PictureStamps::fault_of(const fbs_stamp& stamp) const {
  if (stamp.duration > kMaxDuration) return "a picture lasts for a minute at most";
  if (stamp.time == FBS_NO_TIME) return nullptr;
  if (stamp.time < -kMaxTime || stamp.time > kMaxTime) return "a time beyond +-2^61 ticks";
  if (last_time_ && stamp.time <= *last_time_) return "the time is not later than that of the picture before";
  return nullptr;
}

std::uint64_t PictureStamps::begin_of(std::int64_t time) {
  if (!last_time_) origin_ = time - static_cast<std::int64_t>(end_);
  last_time_ = time;
  const auto latest = static_cast<std::int64_t>(begin_ + kMaxDuration);
  origin_ += std::max<std::int64_t>(0, time - origin_ - latest);
  return static_cast<std::uint64_t>(time - origin_);
}

PictureTime PictureStamps::add(const fbs_stamp& stamp) {
  const bool is_first = first_ + stamps_.size() == 0;
  std::optional<std::uint64_t> begin;
  std::uint32_t duration = stamp.duration;
  if (stamp.time != FBS_NO_TIME) {
    begin = begin_of(stamp.time);
    if (!is_first) {
      const std::uint64_t lasted = *begin > begin_ ? *begin - begin_ : 1;
      second_last_ = std::exchange(last_, static_cast<std::uint32_t>(lasted));
    }
    if (duration == 0) duration = second_last_ > 0 ? std::min(last_, second_last_) : last_;
  }
  begin_ = begin.value_or(end_);
  end_ = begin_ + (duration > 0 ? duration : nominal_);
  stamps_.push_back(stamp);
  return {duration, begin};
}

const fbs_stamp* PictureStamps::of(std::uint64_t picture) const {
  return picture >= first_ && picture - first_ < stamps_.size()
             ? &stamps_[static_cast<std::size_t>(picture - first_)]
             : nullptr;
}

void PictureStamps::forget(std::uint64_t before) {
  for (; first_ < before && !stamps_.empty(); ++first_) stamps_.pop_front();
}

}  // namespace fbs
