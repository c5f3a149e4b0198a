// The stamps of an encoder's pictures: fbs_stamp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "encoder/plan/group_clock.h"
#include "fbs/encoder.h"

namespace fbs {

/// sizeof(fbs_stamp) in version 0.3.
inline constexpr std::size_t kFirstStampSize = offsetof(fbs_stamp, duration) + sizeof(std::uint32_t);

inline constexpr fbs_stamp kNoStamp = {sizeof(fbs_stamp), FBS_NO_TIME, 0, 0};

/// Turns times of a caller's clock into times of the stream, and keeps stamps until no packet to come
/// belongs to their pictures.
class PictureStamps {
 public:
  /// @param nominal  duration of a picture, 1/90000 s
  explicit PictureStamps(std::uint32_t nominal) : nominal_(nominal) {}

  /// Why the next picture cannot have this stamp; null: it can.
  [[nodiscard]] const char* fault_of(const fbs_stamp& stamp) const;
  /// Adds the next picture's stamp, which has no fault.
  /// @return when the picture is shown; its duration is expected, if the stamp has none
  PictureTime add(const fbs_stamp& stamp);

  /// Null if the picture has been forgotten, or not been added.
  [[nodiscard]] const fbs_stamp* of(std::uint64_t picture) const;
  /// Forgets pictures before this one.
  void forget(std::uint64_t before);

 private:
  /// Moves the origin where more than kMaxDuration has passed since the picture before.
  [[nodiscard]] std::uint64_t begin_of(std::int64_t time);

  std::uint32_t nominal_;
  std::int64_t origin_ = 0;  ///< of the stream, by the clock
  std::optional<std::int64_t> last_time_;
  std::uint64_t begin_ = 0, end_ = 0;         ///< of the picture added last; its end is expected
  std::uint32_t last_ = 0, second_last_ = 0;  ///< durations of the pictures before it; 0: unknown
  std::deque<fbs_stamp> stamps_;
  std::uint64_t first_ = 0;  ///< picture of the first of stamps_
};

}  // namespace fbs
