#include "bitstream/scene/timeline.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace fbs {

Result<void> Timeline::add(std::span<const State> states, std::span<const std::uint32_t> durations,
                           std::int32_t guessed) {
  assert(states.size() == durations.size());
  const std::int64_t new_end = end() + static_cast<std::int64_t>(states.size());
  if (new_end - next_ > kMaxWaitingPictures || new_end > static_cast<std::int64_t>(kMaxPictureNumber))
    return fail(ErrorCode::kTooLarge, "too many pictures wait for their patterns");
  for (std::size_t i = 0; i < states.size(); ++i) {
    entries_.push_back({states[i], end_position_, durations[i], std::cmp_less(i, guessed)});
    State& state = entries_.back().state;
    state.picture = end() - 1;
    if (!ahead_.empty()) {
      state.blend = ahead_.front();
      ahead_.pop_front();
    }
    ++end_position_.pictures;
    end_position_.time += durations[i];
  }
  return {};
}

Result<void> Timeline::release(std::int32_t first, std::span<const RegionModes> modes) {
  assert(first >= with_modes_);
  const std::int64_t new_end = first + static_cast<std::int64_t>(modes.size());
  if (new_end - end() > kMaxWaitingPictures)
    return fail(ErrorCode::kTooLarge, "a blend packet is too far ahead of the motion");
  for (; with_modes_ < new_end; ++with_modes_) {
    if (with_modes_ >= first) last_modes_ = modes[with_modes_ - first];
    if (with_modes_ < end())
      entries_[with_modes_ - first_].state.blend = last_modes_;
    else
      ahead_.push_back(last_modes_);
  }
  return {};
}

Timeline::Entry Timeline::next() {
  assert(has_next());
  const Entry entry = entries_[next_ - first_];
  ++next_;
  for (; next_ - first_ > kKeptPictures; ++first_) entries_.pop_front();
  return entry;
}

void Timeline::go_on(const StreamPosition& next) {
  const Entry* const known = find(next_);
  const StreamPosition before = known != nullptr ? known->position : end_position_;
  const auto move = [&](StreamPosition& position) {  // modulo 2^64
    position.pictures += next.pictures - before.pictures;
    position.time += next.time - before.time;
  };
  for (std::int32_t picture = next_; picture < end(); ++picture) move(entries_[picture - first_].position);
  move(end_position_);
}

const Timeline::Entry* Timeline::find(std::int32_t picture) const {
  if (picture < first_ || picture - first_ >= static_cast<std::int32_t>(entries_.size())) return nullptr;
  return &entries_[picture - first_];
}

}  // namespace fbs
