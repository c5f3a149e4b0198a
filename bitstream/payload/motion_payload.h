// The motion packet: the tracks of a group of pictures. SPEC 4.5.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/payload/track_coder.h"
#include "bitstream/syntax.h"
#include "common/result.h"

namespace fbs {

using PartCosts = std::array<std::uint64_t, kPartCount + 1>;

/// Writes or reads the motion packets of one scene, in stream order. Contexts, last knots and last durations
/// go on from group to group; a key group begins them anew. Use one object for writing and another for
/// reading. A value: a copy goes on independently, so that an encoder may try what a group would cost.
class MotionCoder {
 public:
  /// @param setup  of the scene; must satisfy check_setup (assert)
  /// @param seen   of pattern 0: the anchor of key groups
  MotionCoder(const Setup& setup, const CodedState& seen);

  /// Codes the group that follows.
  /// @return kInvalidArgument  no pictures or more than kMaxGroupPictures; not a key group where one is
  ///                           needed; tracks that are not as MotionGroup says; durations neither empty nor
  ///                           one for each picture, or outside 1..kMaxDuration; numbers beyond their limits.
  ///                           The coder is then as before the call.
  [[nodiscard]] Result<std::vector<std::uint8_t>> encode(const MotionGroup& group);

  /// Reads the group that follows. After an error only a key group can be read.
  /// @return kTruncated      the payload ends early
  ///         kInvalidStream  damaged, or not a key group where one is needed
  [[nodiscard]] Result<MotionGroup> decode(std::span<const std::uint8_t> payload);

  /// The coded state before the first picture of the next group.
  [[nodiscard]] const CodedState& anchor(bool key) const { return key ? seen_ : last_; }

  /// A packet was lost: only a key group can follow.
  void lose() { needs_key_ = true; }

  /// True before the first group and after a loss.
  [[nodiscard]] bool needs_key() const { return needs_key_; }

  [[nodiscard]] const CodedLimits& limits() const { return limits_; }

  /// What the parts of all groups so far have cost, in 1/256 bit; behind them the durations.
  [[nodiscard]] const PartCosts& cost_of_parts() const { return costs_; }

 private:
  /// Adds to the costs what the group costs after `before`.
  void count(TrackMemory before, MotionGroup group);

  CodedLimits limits_;
  std::uint32_t nominal_duration_;
  CodedState seen_, last_;
  TrackMemory memory_;
  bool needs_key_ = true;
  PartCosts costs_{};
};

}  // namespace fbs
