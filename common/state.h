// The state of a picture: all that changes from picture to picture, as integers. SPEC 5.1.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

#include "common/generic_head.h"

namespace fbs {

/// Index of each number of the head pose in State::pose.
enum PoseIndex : std::uint8_t { kPitch, kYaw, kRoll, kShiftX, kShiftY, kLogScale };
inline constexpr int kPoseCount = 6;
inline constexpr int kParameterCount = kPoseCount + 2 * kControlCount;

/// Everything the decoder needs beside the scene to draw one picture. All numbers are absolute and count
/// quantiser steps (QuantiserSteps); control points are offsets from the adapted, expressionless face.
struct State {
  std::array<std::int32_t, kPoseCount> pose{};
  std::array<glm::ivec2, kControlCount> control{};  ///< x, y in the head frame

  friend bool operator==(const State&, const State&) = default;
};

/// Size of one step of each part of the state. Sent once, in the setup packet; all are 1..65535.
struct QuantiserSteps {
  std::int32_t rotation = 64;     ///< 2^-16 turn
  std::int32_t translation = 16;  ///< 1/64 pixel
  std::int32_t log_scale = 8;     ///< 2^-12 octave of the eye distance in pixels
  std::int32_t control = 32;      ///< head units (1/4096 eye distance)
  friend bool operator==(const QuantiserSteps&, const QuantiserSteps&) = default;
};

/// Limits of a state's numbers after multiplication with their steps; a stream that leaves them is invalid.
inline constexpr std::int32_t kMaxRotation = 1 << 14;           ///< a quarter turn either way
inline constexpr std::int32_t kMaxTranslation = 2 * 8192 * 64;  ///< two of the largest pictures
inline constexpr std::int32_t kMaxLogScale = 13 << 12;          ///< 0..8192 pixels of eye distance
inline constexpr std::int32_t kMaxControl = 2 * kUnitsPerEyeDistance;

/// Which features a stream sends, bit i for FeatureId i; the control points of the others stay zero.
using FeatureMask = std::uint16_t;

}  // namespace fbs
