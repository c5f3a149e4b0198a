// Landmarks by name, and their places on the generic head.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "common/generic_head.h"

namespace fbs {

/// Points of iBUG-68 that are asked for by name. "right" and "left" are the subject's own.
namespace ibug {
inline constexpr int kJawFirst = 0, kChin = 8, kJawEnd = 17;
inline constexpr int kBrowRight = 17, kBrowLeft = 22, kBrowPoints = 5;
inline constexpr int kNoseBridge = 27, kNoseTip = 30, kNoseBase = 33, kNoseEnd = 36;
inline constexpr int kEyesFirst = 36, kEyesEnd = 48, kEyePoints = 6;  ///< the right eye's come first
inline constexpr int kRightEyeOuter = 36, kRightEyeInner = 39, kLeftEyeInner = 42, kLeftEyeOuter = 45;
inline constexpr int kRightLowerLid = 40, kLeftLowerLid = 46;  ///< the first of two points
inline constexpr int kMouthFirst = 48, kMouthRight = 48, kMouthLeft = 54, kMouthEnd = 68;
inline constexpr int kUpperLipTop = 51, kLowerLipBottom = 57;   ///< outer borders on the midline
inline constexpr int kUpperLipInner = 62, kLowerLipInner = 66;  ///< inner borders on the midline
}  // namespace ibug

/// The jaw's landmark on the other side.
[[nodiscard]] constexpr int mirrored_jaw(int landmark) {
  return 2 * ibug::kChin - landmark;
}

/// Lid point or eye corner.
[[nodiscard]] constexpr bool is_eye_landmark(int landmark) {
  return landmark >= ibug::kEyesFirst && landmark < ibug::kEyesEnd;
}

/// Mean depth of the generic head's lids and eye corners in the head frame, eye distances.
[[nodiscard]] double generic_eye_depth();

/// A vertex of the generic head, eye distances; z is counted from the eyes' depth backwards.
[[nodiscard]] glm::dvec3 generic_vertex(std::size_t vertex);

/// The same of a landmark.
[[nodiscard]] inline glm::dvec3 generic_landmark(int landmark) {
  return generic_vertex(vertex_of_landmark(landmark));
}

}  // namespace fbs
