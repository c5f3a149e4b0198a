#include "decoder/stream/stream_clock.h"

#include <algorithm>
#include <cassert>

namespace fbs {

void StreamClock::show(std::uint32_t duration) {
  assert(!is_behind());
  ++now_.pictures;
  now_.time += duration;
  target_ = now_;
  has_picture_ = true;
  held_in_a_row_ = 0;
}

Result<std::uint64_t> StreamClock::go_to(const StreamPosition& target) {
  if (!started_) {
    started_ = true;
    start_ = now_ = target_ = target;
    return 0;
  }
  if (target.pictures < now_.pictures)
    return fail(ErrorCode::kInvalidStream, "fewer pictures than have been shown");
  const std::uint64_t missing = target.pictures - now_.pictures;
  const bool fits = target.time >= now_.time && can_last(missing, target.time - now_.time);
  if (!fits && !lost_)
    return fail(ErrorCode::kInvalidStream, "a time that does not fit the number of pictures");
  lost_ = false;
  missing_ += missing;
  target_ = target;
  if (!fits || !has_picture_ || held_in_a_row_ + missing > kMaxHeldPictures) now_ = target;
  return missing;
}

Result<std::uint64_t> StreamClock::go_to_end(std::uint64_t pictures, std::uint32_t nominal) {
  if (!started_) return 0;
  const std::uint64_t missing = pictures - std::min(pictures, now_.pictures);
  return go_to({pictures, now_.time + missing * nominal});
}

std::uint32_t StreamClock::hold(std::uint32_t nominal) {
  assert(is_behind());
  // SPEC 6.2: each picture that follows needs at least 1 and at most kMaxDuration, and the last takes the
  // rest.
  const std::uint64_t after = target_.pictures - now_.pictures - 1, left = target_.time - now_.time;
  const std::uint64_t most = left - after;
  const std::uint64_t least = left - std::min(left - 1, after * kMaxDuration);
  const auto duration = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(nominal, least, most));
  ++now_.pictures;
  now_.time += duration;
  ++held_in_a_row_;
  ++held_;
  return duration;
}

}  // namespace fbs
