// The state of a picture: all that changes from picture to picture, as integers. SPEC 5.1.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

#include "common/generic_head.h"

namespace fbs {

/// Index of each number of the head pose in State::pose: rotations in 2^-16 turn, shifts in 1/64 pixel, the
/// binary logarithm of the eye distance in pixels in 2^-12.
enum PoseIndex : std::uint8_t { kPitch, kYaw, kRoll, kShiftX, kShiftY, kLogScale };
inline constexpr int kPoseCount = 6;

/// Index of each number of the light on the face in State::light: what is added to the pattern's luma, in
/// 1/16 grey level; for the gain to luma that is 64 levels brighter than 128, for the slopes one eye distance
/// to the right of or below the head's origin; for the rest u^2, v^2 and u v eye distances from the middle of
/// the face, half an eye distance below the origin.
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

/// Of the face, below the head's origin, head units.
inline constexpr int kFaceMiddle = kUnitsPerEyeDistance / 2;

/// Index of each number of the mouth's inside in State::interior: what is added to its luma at the upper lip,
/// half way and at the lower lip, in 1/16 grey level.
enum MouthInteriorIndex : std::uint8_t { kInteriorUpper, kInteriorMiddle, kInteriorLower };
inline constexpr int kInteriorCount = 3;

/// Index of each number of a flat part of the surround, body or ground: how far it has gone since pattern 0,
/// in 1/64 pixel; growth and turn as the way of a point one eye distance from the head's origin.
enum SimilarityIndex : std::uint8_t { kDisplacementX, kDisplacementY, kSimilarityScale, kSimilarityRotation };
inline constexpr int kSimilarityCount = 4;

/// Everything the decoder needs beside the scene to draw one picture. All numbers are absolute.
struct State {
  std::array<std::int32_t, kPoseCount> pose{};
  std::array<std::int32_t, kLightCount> light{};
  std::array<std::int32_t, kInteriorCount> interior{};
  std::array<std::int32_t, kSimilarityCount> body{};
  std::array<std::int32_t, kSimilarityCount> ground{};
  /// Offsets from the adapted, expressionless face, x, y in the head frame, head units.
  std::array<glm::ivec2, kControlCount> control{};

  friend bool operator==(const State&, const State&) = default;
};

/// Size of one step of each part of the state. Sent once, in the setup packet; all are 1..65535.
struct QuantiserSteps {
  std::int32_t rotation = 64;     ///< 2^-16 turn
  std::int32_t translation = 16;  ///< 1/64 pixel; of body and ground, too
  std::int32_t log_scale = 8;     ///< 2^-12 octave of the eye distance in pixels
  std::int32_t light = 16;        ///< 1/16 grey level; of the mouth's inside, too
  std::int32_t control = 32;      ///< coefficients of the expression, head units (1/4096 eye distance)
  friend bool operator==(const QuantiserSteps&, const QuantiserSteps&) = default;
};

/// Limits of a state's numbers; a stream that leaves them is invalid.
inline constexpr std::int32_t kMaxRotation = 1 << 14;           ///< a quarter turn either way
inline constexpr std::int32_t kMaxTranslation = 2 * 8192 * 64;  ///< two of the largest pictures
inline constexpr std::int32_t kMaxLogScale = 13 << 12;          ///< 0..8192 pixels of eye distance
inline constexpr std::int32_t kMaxLight = 256 * 16;             ///< from black to white
inline constexpr std::int32_t kMaxControl = 2 * kUnitsPerEyeDistance;

}  // namespace fbs
