// Motion packets to groups of pictures. SPEC 4.5.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "bitstream/motion/motion_syntax.h"
#include "common/result.h"

namespace fbs {

/// Reads the motion packets of one scene. Some may be missing; what comes twice or too late is skipped.
class MotionDecoder {
 public:
  /// @param setup  of the scene; must satisfy check_setup (assert)
  /// @param seen   seen state of the first pattern: the anchor of key groups
  /// @param passed  pictures of the scene before the first that is to come
  MotionDecoder(const Setup& setup, const CodedState& seen, const StreamPosition& passed = {});

  /// Reads the next group. After an error or a missing group only a key group can be read.
  /// @return nothing if the group has come before, or needs one that is missing
  ///         kTruncated      the payload ends early
  ///         kInvalidStream  damaged, or the scene does not begin with a key group
  [[nodiscard]] Result<std::optional<MotionGroup>> decode(std::span<const std::uint8_t> payload);

  /// True before the first group, after an error and after a missing group.
  [[nodiscard]] bool needs_key() const { return reference_.order.needs_key; }

 private:
  MotionReference reference_;
};

}  // namespace fbs
