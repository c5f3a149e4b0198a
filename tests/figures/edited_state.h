// States set by hand: motion "coming through keyboard". Paper section 3.
#pragma once

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

}  // namespace fbs::figures
