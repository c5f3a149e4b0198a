// Groups of pictures to motion packets. SPEC 4.5.
#pragma once

#include <cstdint>
#include <vector>

#include "bitstream/motion/motion_syntax.h"
#include "common/result.h"

namespace fbs {

/// Writes the motion packets of one scene, in stream order. A value: a copy continues independently, so that
/// an encoder can try what a group would cost.
class MotionEncoder {
 public:
  /// @param setup  of the scene; must satisfy check_setup (assert)
  /// @param seen   seen state of the first pattern: the anchor of key groups
  /// @param repeats_moved  a key group sends each part that the group before it has moved: costs some 7 % of
  ///                       the rate with groups of 0.2 s, and a lost group is forgotten with the next
  MotionEncoder(const Setup& setup, const CodedState& seen, bool repeats_moved = false)
      : reference_(setup, seen) {
    reference_.repeats_moved = repeats_moved;
  }

  /// Codes the next group.
  /// @return kInvalidArgument  a number of pictures outside 1..kMaxGroupPictures; not a key group where one
  ///                           is needed; another first picture or anchor than next() and anchor(); tracks
  ///                           that are not as defined in MotionGroup; durations neither empty nor one for
  ///                           each picture, or outside 1..kMaxDuration; numbers outside limits(). The
  ///                           encoder is then unchanged.
  [[nodiscard]] Result<std::vector<std::uint8_t>> encode(const MotionGroup& group);

  /// The state before the first picture of the next group, and the number of that picture.
  [[nodiscard]] const CodedState& anchor() const { return reference_.last; }
  [[nodiscard]] std::int32_t next() const { return reference_.order.next; }

  /// Groups coded so far. The first is a key group.
  [[nodiscard]] int groups() const { return groups_; }

  [[nodiscard]] const CodedLimits& limits() const { return reference_.limits; }

 private:
  MotionReference reference_;
  int groups_ = 0;
};

}  // namespace fbs
