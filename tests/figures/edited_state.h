// States by hand: motion "coming through keyboard" and motion of another face. Paper section 3.
#pragma once

#include "bitstream/syntax.h"
#include "common/state.h"

namespace fbs::figures {

/// `state` with the head turned by more. Degrees; positive yaw turns the nose to the left of the picture,
/// positive pitch down.
[[nodiscard]] State turned(State state, double yaw_deg, double pitch_deg);

/// `state` with both brows raised by more, in the most probable way.
/// @param height  eye distances, mean of their control points
[[nodiscard]] State with_brows_raised(State state, double height);

/// `state` with the mouth opened by more, in the most probable way.
/// @param height  eye distances, between the middles of the inner lips
[[nodiscard]] State with_mouth_open(State state, double height);

/// Somebody in a state, and their first picture's.
struct Actor {
  const Geometry& geometry;
  const State& rest;
};

/// The state in which `to` does what `from` does in `state`: the pose changes alike, from each one's own
/// rest, and control points move in proportion to the size of mouth, brows and eyes.
[[nodiscard]] State transferred(const State& state, const Actor& from, const Actor& to);

/// Between the middles of the inner lips, eye distances.
[[nodiscard]] double mouth_gap(const State& state, const Actor& actor);

}  // namespace fbs::figures
