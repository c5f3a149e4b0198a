// Derives the settings of the two passes over a scene, motion and then patterns, from the encoder's.
#pragma once

#include <memory>

#include "encoder/plan/rate_control.h"
#include "encoder/segment/file_patterns.h"
#include "encoder/segment/live_patterns.h"
#include "encoder/settings.h"

namespace fbs {

/// Threads that encode, at least 1.
[[nodiscard]] int thread_count(const EncoderSettings& settings);

/// Target of the motion and the first pattern.
[[nodiscard]] RateTarget motion_target(const EncoderSettings& settings, double eye_distance_px);

/// @param motion  operating point of the motion
[[nodiscard]] FilePatternSettings pass_settings(const EncoderSettings& settings,
                                                const OperatingPoint& motion);

/// The same for a scene without a face: more patterns, in place of motion.
[[nodiscard]] FilePatternSettings planar_pass_settings(const EncoderSettings& settings,
                                                       const OperatingPoint& motion);

/// The stage for the patterns of a scene, live or with look-ahead.
/// @param pass  from one of the functions above
/// @param rest  seen state of pattern 0 as coded
[[nodiscard]] std::unique_ptr<PatternStage> pattern_stage(FilePatternSettings pass,
                                                          const EncoderSettings& settings,
                                                          const VideoFormat& format, const CodedState& rest);

}  // namespace fbs
