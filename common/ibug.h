// iBUG-68 landmarks that code names. "right" and "left" are the subject's own.
#pragma once

namespace fbs::ibug {

inline constexpr int kJawFirst = 0, kChin = 8, kJawEnd = 17;
inline constexpr int kBrowsFirst = 17, kBrowLeft = 22, kBrowsEnd = 27;
inline constexpr int kNoseFirst = 27, kNoseTip = 30, kNoseBase = 33, kNoseEnd = 36;
inline constexpr int kEyesFirst = 36, kEyesEnd = 48, kEyePoints = 6;  ///< the right eye's come first
inline constexpr int kRightEyeOuter = 36, kRightEyeInner = 39, kLeftEyeInner = 42, kLeftEyeOuter = 45;
inline constexpr int kRightLowerLid = 40, kLeftLowerLid = 46;  ///< the first of two points
inline constexpr int kMouthFirst = 48, kMouthRight = 48, kMouthLeft = 54, kMouthEnd = 68;
inline constexpr int kOuterLipsFirst = 48, kInnerLipsFirst = 60;
inline constexpr int kUpperLipTop = 51, kLowerLipBottom = 57;   ///< outer borders on the midline
inline constexpr int kUpperLipInner = 62, kLowerLipInner = 66;  ///< inner borders on the midline

}  // namespace fbs::ibug
