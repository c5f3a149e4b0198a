// What the encoder's settings mean for the two passes over a scene: motion, then patterns.
#pragma once

#include "encoder/pattern_pass.h"
#include "encoder/plan/rate_control.h"
#include "encoder/settings.h"

namespace fbs {

/// What quality means for the motion and the first pattern.
[[nodiscard]] RateTarget motion_target(const EncoderSettings& settings, double eye_distance_px);

/// @param motion  operating point of the motion
[[nodiscard]] PatternPassSettings pass_settings(const EncoderSettings& settings,
                                                const OperatingPoint& motion);

/// The same for a scene without a face: more patterns, in the place of motion.
[[nodiscard]] PatternPassSettings planar_pass_settings(const EncoderSettings& settings,
                                                       const OperatingPoint& motion);

}  // namespace fbs
