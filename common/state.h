// The state of a picture: everything that changes from picture to picture, as integers. SPEC 5.1.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

#include "common/generic_head.h"

namespace fbs {

/// Indices into State::pose: rotations in 2^-16 turns, translation in 1/64 pixel, and the binary logarithm of
/// the eye distance in pixels, in 2^-12 octaves.
enum PoseIndex : std::uint8_t { kPitch, kYaw, kRoll, kShiftX, kShiftY, kLogScale };
inline constexpr int kPoseCount = 6;

/// Indices into State::light: terms added to the pattern's luma, in 1/16 grey level. Offset; gain, per 64
/// levels above luma 128; slopes, per eye distance to the right of and below the head's origin; quadratic
/// terms, per squared eye distance from the middle of the face, which is half an eye distance below the
/// origin.
enum LightIndex : std::uint8_t {
  kLightOffset,
  kLightGain,
  kLightSlopeX,
  kLightSlopeY,
  kLightQuadraticXX,
  kLightQuadraticYY,
  kLightQuadraticXY,
};
inline constexpr int kLightCount = 7;

/// Middle of the face below the head's origin, head units.
inline constexpr int kFaceMiddle = kUnitsPerEyeDistance / 2;

/// Indices into State::interior: what is added to the luma of the mouth interior at the upper lip, half way
/// and at the lower lip, in 1/16 grey level.
enum MouthInteriorIndex : std::uint8_t { kInteriorUpper, kInteriorMiddle, kInteriorLower };
inline constexpr int kInteriorCount = 3;

/// Indices into State::body and State::ground: a similarity relative to the rest state, in 1/64 pixel. Scale
/// and rotation are given as the displacement of a point one eye distance from the head's origin.
enum SimilarityIndex : std::uint8_t { kDisplacementX, kDisplacementY, kSimilarityScale, kSimilarityRotation };
inline constexpr int kSimilarityCount = 4;

/// Regions of the picture, each of which has its own blend of patterns. SPEC 11.1.
enum class Region : std::uint8_t { kMouth, kRightEye, kLeftEye, kFace, kHair, kBody, kGround };
inline constexpr std::size_t kRegionCount = 7;

/// How a region is blended from the patterns. SPEC 11.4.
enum class BlendMode : std::uint8_t {
  kByState,      ///< weights follow from the distances of states and times
  kByTime,       ///< cross-fade from the previous pattern to the next
  kHalfStill,    ///< half kByState, half the cross-fade without motion
  kStillBefore,  ///< the previous pattern without motion
  kStillAfter,   ///< the next pattern without motion
  kNearest,      ///< this and the following: half kByState, half the nearest pattern, the second nearest, ...
};
inline constexpr int kNearestCount = 8;
inline constexpr int kBlendModeCount = static_cast<int>(BlendMode::kNearest) + kNearestCount;
using RegionModes = std::array<BlendMode, kRegionCount>;

/// Everything the decoder needs besides the scene to draw one picture. All values are absolute.
struct State {
  std::array<std::int32_t, kPoseCount> pose{};
  std::array<std::int32_t, kLightCount> light{};
  std::array<std::int32_t, kInteriorCount> interior{};
  std::array<std::int32_t, kSimilarityCount> body{};
  std::array<std::int32_t, kSimilarityCount> ground{};
  /// Offsets from the adapted, expressionless face, x, y in the head frame, head units.
  std::array<glm::ivec2, kControlCount> control{};
  std::int32_t picture = 0;  ///< number in the scene: the time by which patterns are near or far
  RegionModes blend{};

  friend bool operator==(const State&, const State&) = default;
};

/// Quantiser step of each part of the state. Sent once, in the setup packet; all are 1..65535.
struct QuantiserSteps {
  std::int32_t rotation = 64;     ///< 2^-16 turn
  std::int32_t translation = 16;  ///< 1/64 pixel; also for body and ground
  std::int32_t log_scale = 8;     ///< 2^-12 octave of the eye distance in pixels
  std::int32_t light = 16;        ///< 1/16 grey level; also for the mouth interior
  std::int32_t control = 32;      ///< coefficients of the expression, head units (1/4096 eye distance)
  friend bool operator==(const QuantiserSteps&, const QuantiserSteps&) = default;
};

/// Limits of the values of a state; a stream that exceeds them is invalid.
inline constexpr std::int32_t kMaxRotation = 1 << 14;           ///< a quarter turn in either direction
inline constexpr std::int32_t kMaxTranslation = 2 * 8192 * 64;  ///< twice the largest picture
inline constexpr std::int32_t kMaxLogScale = 13 << 12;          ///< 0..8192 pixels of eye distance
inline constexpr std::int32_t kMaxLight = 256 * 16;             ///< from black to white
inline constexpr std::int32_t kMaxControl = 2 * kUnitsPerEyeDistance;

}  // namespace fbs
