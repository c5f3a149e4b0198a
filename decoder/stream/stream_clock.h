// Numbers and times of the pictures of a stream, and those that are missing. SPEC 6.1, 6.2.
#pragma once

#include <cstdint>

#include "bitstream/syntax.h"
#include "common/result.h"

namespace fbs {

/// Knows where in the stream the next picture belongs. Where the stream says that it is later than that,
/// pictures are missing: the last picture is shown again for each, so that those behind keep their numbers
/// and times.
class StreamClock {
 public:
  /// Where the stream begins: with its first setup packet or, if something was lost before, at 0, 0.
  [[nodiscard]] const StreamPosition& start() const { return start_; }
  /// Where the next picture belongs.
  [[nodiscard]] const StreamPosition& now() const { return now_; }

  /// Something was lost. If nothing has said yet where the stream begins, it is at 0, 0.
  void lose() { started_ = true; }

  /// The next picture of a scene is shown. Not while is_behind() (assert).
  /// @param duration  1/90000 s
  void show(std::uint32_t duration);

  /// The next picture of a scene belongs to `target`. What is missing before is held from now on, or left
  /// out: if no picture has been shown, or if more than kMaxHeldPictures would be held in a row.
  /// @return how many are missing; kInvalidStream, and nothing changes, if more pictures than the target's
  /// have
  ///         been shown, or if the missing ones cannot take the time up to it
  [[nodiscard]] Result<std::uint64_t> go_to(const StreamPosition& target);

  /// The same for the end of the stream, of which only the number of pictures is known.
  /// @param nominal  duration of the missing ones, 1/90000 s
  [[nodiscard]] Result<std::uint64_t> go_to_end(std::uint64_t pictures, std::uint32_t nominal);

  /// Whether the last picture is to be shown again.
  [[nodiscard]] bool is_behind() const { return now_.pictures < target_.pictures; }
  /// The last picture is shown again. Only while is_behind() (assert).
  /// @param nominal  1/90000 s
  /// @return its duration, 1..kMaxDuration: nominal as far as that brings the last one to the target's time
  std::uint32_t hold(std::uint32_t nominal);

  [[nodiscard]] std::uint64_t held() const { return held_; }        ///< pictures, so far
  [[nodiscard]] std::uint64_t missing() const { return missing_; }  ///< of the stream, held or not

 private:
  bool started_ = false;
  StreamPosition start_, now_;
  StreamPosition target_;  // no earlier than now_
  bool has_picture_ = false;
  std::uint64_t held_in_a_row_ = 0, held_ = 0, missing_ = 0;
};

}  // namespace fbs
