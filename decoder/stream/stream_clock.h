// Numbers and times of a stream's pictures, and which are missing. SPEC 6.1, 6.2.
#pragma once

#include <cstdint>

#include "bitstream/syntax.h"
#include "common/result.h"

namespace fbs {

/// Keeps the position of the next picture. If the stream gives a later one, pictures are missing: the last
/// picture is repeated for each, so that later pictures keep their numbers and times.
class StreamClock {
 public:
  /// Start of the stream: at its first setup packet or, if something was lost before, at 0, 0.
  [[nodiscard]] const StreamPosition& start() const { return start_; }
  /// Position of the next picture.
  [[nodiscard]] const StreamPosition& now() const { return now_; }

  /// Records a loss: times may be wrong up to the next target. If the start of the stream is not known yet,
  /// it is 0, 0.
  void lose() { started_ = lost_ = true; }

  /// Advances past the next picture of a scene. Not while is_behind() (assert).
  /// @param duration  1/90000 s
  void show(std::uint32_t duration);

  /// The next picture of a scene belongs to `target`. Missing pictures before it are held from now on, or
  /// left out: if no picture has been shown, or if more than kMaxHeldPictures would be held in a row.
  /// @return how many are missing; kInvalidStream, and nothing changes, if more pictures than the target's
  /// have
  ///         been shown or, where nothing is lost, if the missing ones cannot take the time up to it
  [[nodiscard]] Result<std::uint64_t> go_to(const StreamPosition& target);

  /// The same for the end of the stream, where only the number of pictures is known.
  /// @param nominal  duration of the missing ones, 1/90000 s
  [[nodiscard]] Result<std::uint64_t> go_to_end(std::uint64_t pictures, std::uint32_t nominal);

  /// Whether the last picture is to be shown again.
  [[nodiscard]] bool is_behind() const { return now_.pictures < target_.pictures; }
  /// Repeats the last picture. Only while is_behind() (assert).
  /// @param nominal  1/90000 s
  /// @return its duration, 1..kMaxDuration: nominal as far as that brings the last one to the target's time
  std::uint32_t hold(std::uint32_t nominal);

  [[nodiscard]] std::uint64_t held() const { return held_; }        ///< pictures, so far
  [[nodiscard]] std::uint64_t missing() const { return missing_; }  ///< of the stream, held or not

 private:
  bool started_ = false, lost_ = false;
  StreamPosition start_, now_;
  StreamPosition target_;  // no earlier than now_
  bool has_picture_ = false;
  std::uint64_t held_in_a_row_ = 0, held_ = 0, missing_ = 0;
};

}  // namespace fbs
