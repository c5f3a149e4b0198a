// Where in the stream the pictures of a group are.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "bitstream/syntax.h"

namespace fbs {

/// When a picture is shown.
struct PictureTime {
  std::uint32_t duration;  ///< 1/90000 s, at most kMaxDuration; 0: the frame rate's
  /// Since the beginning of the stream, 1/90000 s. Nothing: where the picture before ends.
  std::optional<std::uint64_t> begin;

  // NOLINTNEXTLINE(google-explicit-constructor): most pictures have a duration alone
  PictureTime(std::uint32_t lasts = 0, std::optional<std::uint64_t> begins = std::nullopt)
      : duration(lasts), begin(begins) {}
};

/// Makes durations, which a stream has, of the times at which pictures begin. A picture ends where the next
/// one begins, which is known too late for the last picture of a group that has been coded. That one keeps
/// the duration it was added with, and the one after it makes up for the difference. So times do not drift.
class GroupClock {
 public:
  /// @param at       where the first picture begins
  /// @param nominal  duration of a picture, 1/90000 s
  GroupClock(const StreamPosition& at, std::uint32_t nominal)
      : position_(at), begin_(at.time), nominal_(nominal), last_(nominal) {}

  /// Adds a picture to the group. If it has a time to begin, the picture before ends then, if it can.
  void add(const PictureTime& when);
  /// The picture added last ends at this time, if it is of the group: as near to it as durations allow.
  /// @param time  since the beginning of the stream, 1/90000 s
  void end_at(std::uint64_t time);

  /// Begins another group.
  /// @return durations of the pictures of the group before, 1/90000 s; 0: nominal. Empty if it has none
  [[nodiscard]] std::vector<std::uint32_t> end_group();
  [[nodiscard]] std::size_t pictures() const { return durations_.size(); }  ///< of the group
  /// Length of the group, 1/90000 s.
  [[nodiscard]] std::uint64_t lasts() const { return position_.time - begin_; }
  /// Duration of the picture added last, 1/90000 s.
  [[nodiscard]] std::uint32_t last() const { return durations_.empty() ? last_ : ticks(durations_.back()); }

  /// Behind the picture added last.
  [[nodiscard]] const StreamPosition& position() const { return position_; }
  /// Others are shown up to there. No group has begun.
  void go_on(const StreamPosition& at) {
    position_ = at;
    begin_ = at.time;
  }

 private:
  [[nodiscard]] std::uint32_t ticks(std::uint32_t duration) const {
    return duration > 0 ? duration : nominal_;
  }
  /// Duration of a picture from here to this time.
  [[nodiscard]] std::uint32_t until(std::uint64_t end) const;

  StreamPosition position_;
  std::uint64_t begin_;  ///< of the group, as position().time
  std::uint32_t nominal_;
  std::uint32_t last_;  ///< duration of the last picture of the group before
  std::vector<std::uint32_t> durations_;
};

}  // namespace fbs
