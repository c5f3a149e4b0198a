// The pictures of a scene between the packets that announce them and their display.
#pragma once

#include <cstdint>
#include <deque>
#include <span>

#include "bitstream/syntax.h"
#include "common/result.h"
#include "common/state.h"

namespace fbs {

/// States by picture number: those that wait for display and, for patterns that are sent late, the last ones
/// displayed. SPEC 6.
class Timeline {
 public:
  struct Entry {
    State state;
    std::uint32_t duration = 0;  ///< 1/90000 s
  };

  /// The states of the next pictures, which get their numbers.
  /// @return kTooLarge when more than kMaxWaitingPictures would wait, or their numbers exceed
  /// kMaxPictureNumber
  [[nodiscard]] Result<void> add(std::span<const State> states, std::span<const std::uint32_t> durations);

  /// The next pictures that are not released may be displayed, blended as said.
  /// @return kInvalidStream when fewer pictures wait
  [[nodiscard]] Result<void> release(std::span<const RegionModes> modes);
  /// All of them may.
  void release_all() { released_ = end(); }

  [[nodiscard]] bool has_next() const { return next_ < released_; }
  /// The next picture to be displayed; has_next() is true.
  Entry next();

  /// Pictures of the scene whose states have come.
  [[nodiscard]] std::int32_t end() const { return first_ + static_cast<std::int32_t>(entries_.size()); }

  /// State of a picture; null when it is not known, or no longer.
  [[nodiscard]] const State* find(std::int32_t picture) const;

 private:
  std::deque<Entry> entries_;  // pictures first_, first_ + 1, ...
  std::int32_t first_ = 0;     // number of the oldest picture that is kept
  std::int32_t next_ = 0;      // to be displayed
  std::int32_t released_ = 0;  // pictures below this may be displayed
};

}  // namespace fbs
