// The motion packet: the states of a group of pictures. SPEC 4.5.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/state_coder.h"
#include "bitstream/syntax.h"
#include "common/result.h"

namespace fbs {

/// Writes or reads the motion packets of one scene, in stream order. Contexts, last states and last durations
/// go on from group to group; a key group begins them anew. Use one object for writing and another for
/// reading. A value: a copy goes on independently.
class MotionCoder {
 public:
  /// @param setup  of the scene; must satisfy check_setup (assert)
  explicit MotionCoder(const Setup& setup);

  /// Codes the group that follows. Tries the predictions of each part and keeps the shortest.
  /// @return kInvalidArgument  no pictures or more than kMaxGroupPictures; not a key group where one is
  /// needed;
  ///                           durations neither empty nor one for each picture, or outside 1..kMaxDuration;
  ///                           a state beyond its limits or with control points of absent features. The coder
  ///                           is then as before the call.
  [[nodiscard]] Result<std::vector<std::uint8_t>> encode(const MotionGroup& group);

  /// Reads the group that follows. After an error only a key group can be read.
  /// @return kTruncated      the payload ends early
  ///         kTooLarge       more than kMaxGroupPictures
  ///         kInvalidStream  damaged, or not a key group where one is needed
  [[nodiscard]] Result<MotionGroup> decode(std::span<const std::uint8_t> payload);

  /// A packet was lost: only a key group can follow.
  void lose() { needs_key_ = true; }

  /// True before the first group and after a loss.
  [[nodiscard]] bool needs_key() const { return needs_key_; }

  /// Contexts and history as they stand after the last group: where a MotionCounter begins.
  [[nodiscard]] const MotionMemory& memory() const { return memory_; }
  [[nodiscard]] const StateLimits& limits() const { return limits_; }

 private:
  StateLimits limits_;
  std::uint32_t nominal_duration_;
  MotionMemory memory_;
  bool needs_key_ = true;
};

/// Asks what states would cost if they were coded next: push() them one by one. A value: copy it to try
/// alternatives from the same point (about 15 KB, some microseconds). Group header and durations are not
/// counted.
class MotionCounter {
 public:
  /// Goes on from what `coder` coded last; `key`: as the first pictures of a key group.
  explicit MotionCounter(const MotionCoder& coder, bool key = false, PredictionChoice damped = 0);

  /// @param state  within the limits of the scene (assert)
  /// @return cost of this picture in 1/256 bit
  std::uint32_t push(const State& state);

  /// The same without moving on.
  [[nodiscard]] std::uint32_t cost(const State& state) const {
    MotionCounter trial = *this;
    return trial.push(state);
  }

  /// Sum of all push() so far, 1/256 bit.
  [[nodiscard]] std::uint64_t total() const { return total_; }

 private:
  StateLimits limits_;
  MotionMemory memory_;
  PredictionChoice damped_;
  bool key_next_;
  std::uint64_t total_ = 0;
};

}  // namespace fbs
