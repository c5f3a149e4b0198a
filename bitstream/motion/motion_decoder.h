// Motion packets to groups of pictures. SPEC 4.5.
#pragma once

#include <cstdint>
#include <span>

#include "bitstream/motion/motion_syntax.h"
#include "common/result.h"

namespace fbs {

/// Reads the motion packets of one scene, in stream order.
class MotionDecoder {
 public:
  /// @param setup  of the scene; must satisfy check_setup (assert)
  /// @param seen   seen state of the first pattern: the anchor of key groups
  MotionDecoder(const Setup& setup, const CodedState& seen) : reference_(setup, seen) {}

  /// Reads the next group. After an error only a key group can be read.
  /// @return kTruncated      the payload ends early
  ///         kInvalidStream  damaged, or not a key group where one is needed
  [[nodiscard]] Result<MotionGroup> decode(std::span<const std::uint8_t> payload);

  /// True before the first group and after an error.
  [[nodiscard]] bool needs_key() const { return reference_.needs_key; }

 private:
  MotionReference reference_;
};

}  // namespace fbs
