// Tracks through given states, with as few knots as follow them closely.
#pragma once

#include <span>

#include "bitstream/syntax.h"
#include "encoder/retarget/motion_transfer.h"

namespace fbs {

/// Greedy: each span is the longest that stays near all numbers between its ends. Recovers motion in straight
/// lines, such as the tracks of a stream.
/// @param pictures  numbers of each picture of the group, 1..kMaxGroupPictures
/// @param anchor    MotionEncoder::anchor()
[[nodiscard]] MotionGroup fitted_tracks(std::span<const StateNumbers> pictures, const CodedState& anchor,
                                        const Setup& setup);

}  // namespace fbs
