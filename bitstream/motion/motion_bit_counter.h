// Bits of motion by part of the state, for `fbs inspect`.
#pragma once

#include <array>
#include <cstdint>

#include "bitstream/motion/motion_syntax.h"

namespace fbs {

/// Cost of each part in 1/256 bit; the last entry is the cost of the durations. The first part includes the
/// header of the group; key flag and end of the code are not counted.
using PartBitsX256 = std::array<std::uint64_t, kPartCount + 1>;

/// Counts the motion of one scene, beside the MotionEncoder or MotionDecoder that codes it.
class MotionBitCounter {
 public:
  /// @param setup  of the scene; must satisfy check_setup (assert)
  /// @param seen   seen state of the first pattern: the anchor of key groups
  MotionBitCounter(const Setup& setup, const CodedState& seen) : reference_(setup, seen) {}

  /// Counts the next group.
  /// @param group  as accepted by MotionEncoder::encode or returned by MotionDecoder::decode; lost groups are
  ///               left out
  [[nodiscard]] PartBitsX256 count(const MotionGroup& group);

 private:
  MotionReference reference_;
};

}  // namespace fbs
