#include "encoder/plan/group_clock.h"

#include <algorithm>

namespace fbs {
namespace {

/// A duration that is off by so little is taken for that of the picture before, which costs fewest bits:
/// clocks in other units are rounded to ticks. Errors do not add up.
constexpr std::uint64_t kRounding = 1;

}  // namespace

std::uint32_t GroupClock::until(std::uint64_t end) const {
  const std::uint64_t now = position_.time;
  const std::uint64_t exact = std::clamp<std::uint64_t>(end > now ? end - now : 0, 1, kMaxDuration);
  for (const std::uint64_t usual : {std::uint64_t{last()}, std::uint64_t{nominal_}})
    if (exact + kRounding >= usual && exact <= usual + kRounding)
      return usual == nominal_ ? 0 : static_cast<std::uint32_t>(usual);
  return static_cast<std::uint32_t>(exact);
}

void GroupClock::add(const PictureTime& when) {
  if (when.begin) end_at(*when.begin);
  const std::uint32_t duration = when.begin ? until(*when.begin + ticks(when.duration)) : when.duration;
  durations_.push_back(duration);
  position_.add(ticks(duration));
}

void GroupClock::end_at(std::uint64_t time) {
  if (durations_.empty()) return;
  position_.time -= ticks(durations_.back());
  durations_.pop_back();
  const std::uint32_t duration = until(time);
  durations_.push_back(duration);
  position_.time += ticks(duration);
}

std::vector<std::uint32_t> GroupClock::end_group() {
  last_ = last();
  begin_ = position_.time;
  return std::exchange(durations_, {});
}

}  // namespace fbs
