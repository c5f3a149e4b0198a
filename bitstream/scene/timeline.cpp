#include "bitstream/scene/timeline.h"

#include <cassert>

namespace fbs {

Result<void> Timeline::add(std::span<const State> states, std::span<const std::uint32_t> durations) {
  assert(states.size() == durations.size());
  const std::int64_t new_end = end() + static_cast<std::int64_t>(states.size());
  if (new_end - next_ > kMaxWaitingPictures || new_end > static_cast<std::int64_t>(kMaxPictureNumber))
    return fail(ErrorCode::kTooLarge, "too many pictures wait for their patterns");
  for (std::size_t i = 0; i < states.size(); ++i) {
    entries_.push_back({states[i], end_time_, durations[i]});
    entries_.back().state.picture = end() - 1;
    end_time_ += durations[i];
  }
  return {};
}

Result<void> Timeline::release(std::span<const RegionModes> modes) {
  const std::size_t begin = released_ - first_;
  if (modes.size() > entries_.size() - begin)
    return fail(ErrorCode::kInvalidStream, "a blend packet is ahead of the motion");
  for (std::size_t i = 0; i < modes.size(); ++i) entries_[begin + i].state.blend = modes[i];
  released_ += static_cast<std::int32_t>(modes.size());
  return {};
}

Timeline::Entry Timeline::next() {
  assert(has_next());
  const Entry entry = entries_[next_ - first_];
  ++next_;
  for (; next_ - first_ > kKeptPictures; ++first_) entries_.pop_front();
  return entry;
}

const Timeline::Entry* Timeline::find(std::int32_t picture) const {
  if (picture < first_ || picture - first_ >= static_cast<std::int32_t>(entries_.size())) return nullptr;
  return &entries_[picture - first_];
}

}  // namespace fbs
