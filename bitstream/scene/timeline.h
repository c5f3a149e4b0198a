// The pictures of a scene between the packets that announce them and their display.
#pragma once

#include <algorithm>
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
    StreamPosition position;     ///< in the stream, if that does not leave the scene before the picture
    std::uint32_t duration = 0;  ///< 1/90000 s
    bool guessed = false;        ///< the state may be wrong, since a group is missing
  };

  /// @param begin  position of the first picture
  /// @param first  its number
  explicit Timeline(const StreamPosition& begin = {}, std::int32_t first = 0)
      : first_(first), next_(first), with_modes_(first), end_position_(begin) {}

  /// Adds the states of the next pictures and numbers them.
  /// @param guessed  how many of the first of them may be wrong, since a group is missing
  /// @return kTooLarge when more than kMaxWaitingPictures would wait, or their numbers exceed
  /// kMaxPictureNumber
  [[nodiscard]] Result<void> add(std::span<const State> states, std::span<const std::uint32_t> durations,
                                 std::int32_t guessed);

  /// Releases pictures for display, blended in these modes, as soon as they have states. Pictures before
  /// `first` that have no modes get those of the picture before.
  /// @param first  number of the first of them, not below that of any picture with modes (assert)
  /// @return kTooLarge when modes would be more than kMaxWaitingPictures ahead of the states
  [[nodiscard]] Result<void> release(std::int32_t first, std::span<const RegionModes> modes);
  /// Releases all pictures.
  void release_all() { with_modes_ = end(); }

  [[nodiscard]] bool has_next() const { return next_ < released(); }
  /// The next picture to be displayed; has_next() is true.
  Entry next();
  /// The picture that is displayed so many after the next one; null as long as it is not released.
  [[nodiscard]] const Entry* behind_next(std::int32_t pictures) const {
    return next_ + pictures < released() ? &entries_[next_ + pictures - first_] : nullptr;
  }

  /// How many have been displayed.
  [[nodiscard]] std::int32_t displayed() const { return next_; }
  /// The stream returns to the scene: the next picture to be displayed, and those behind it, have another
  /// position. SPEC 6.6.
  void go_on(const StreamPosition& next);
  /// So many have been displayed, whether they are known or not.
  void skip_displayed(std::int32_t pictures) { next_ = std::max(next_, pictures); }

  /// Pictures of the scene whose states have arrived.
  [[nodiscard]] std::int32_t end() const { return first_ + static_cast<std::int32_t>(entries_.size()); }

  /// When the last of them ends, 1/90000 s.
  [[nodiscard]] std::uint64_t end_time() const { return end_position_.time; }

  /// A picture by its number; null when it is unknown, or no longer kept.
  [[nodiscard]] const Entry* find(std::int32_t picture) const;

 private:
  /// Pictures below this may be displayed.
  [[nodiscard]] std::int32_t released() const { return std::min(with_modes_, end()); }

  std::deque<Entry> entries_;      // pictures first_, first_ + 1, ...
  std::int32_t first_ = 0;         // number of the oldest picture that is kept
  std::int32_t next_ = 0;          // to be displayed
  std::int32_t with_modes_ = 0;    // pictures below this have modes
  std::deque<RegionModes> ahead_;  // of those that have no state yet
  RegionModes last_modes_{};
  StreamPosition end_position_;  // behind all entries
};

}  // namespace fbs
