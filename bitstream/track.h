// Tracks: piecewise linear motion from knot to knot. SPEC 5.2.
#pragma once

#include <vector>

#include "bitstream/syntax.h"

namespace fbs {

/// `from + (to - from) * elapsed / length`, rounded to nearest, halves up.
/// @param elapsed  0..length pictures; length > 0
[[nodiscard]] std::int32_t interpolate(std::int64_t from, std::int64_t to, std::int64_t elapsed,
                                       std::int64_t length);

/// One part of the anchor as a knot at picture -1.
[[nodiscard]] Knot anchor_knot(const CodedState& anchor, std::size_t part);

/// The state of each picture of a group, the missing ones before it first. SPEC 6.2.
[[nodiscard]] std::vector<State> states_of(const MotionGroup& group, const QuantiserSteps& steps);

/// The duration of each of them, 1/90000 s.
/// @param rate  pictures per second
[[nodiscard]] std::vector<std::uint32_t> durations_of(const MotionGroup& group, const Rational& rate);

/// The coded state at a group's last picture: the anchor of the next.
[[nodiscard]] CodedState last_of(const MotionGroup& group);

/// A group with a knot of every part in `parts` at every picture; not key.
[[nodiscard]] MotionGroup knots_everywhere(const CodedState& anchor, const std::vector<CodedState>& states,
                                           PartMask parts);

}  // namespace fbs
