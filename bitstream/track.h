// Tracks: what a motion group says of the pictures between its knots. SPEC 5.2.
#pragma once

#include <vector>

#include "bitstream/syntax.h"

namespace fbs {

/// `from + (to - from) * way / length`, rounded to nearest, halves up. 0 <= way <= length, length > 0.
[[nodiscard]] std::int32_t between(std::int64_t from, std::int64_t to, std::int64_t way, std::int64_t length);

/// A part of the anchor as a knot: before the first picture.
[[nodiscard]] Knot anchor_knot(const CodedState& anchor, std::size_t part);

/// The states of a group's pictures.
[[nodiscard]] std::vector<State> states_of(const MotionGroup& group, const QuantiserSteps& steps);

/// The coded state at a group's last picture: the anchor of the next.
[[nodiscard]] CodedState last_of(const MotionGroup& group);

/// A group with a knot of every part in `parts` at every picture; not key.
[[nodiscard]] MotionGroup knots_everywhere(const CodedState& anchor, const std::vector<CodedState>& states,
                                           PartMask parts);

}  // namespace fbs
