// The state as coded in the stream: a row of integers in quantiser steps, divided into parts. SPEC 5.1.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "common/state.h"

namespace fbs {

/// Numbers that are coded together and share their knots.
enum class PartId : std::uint8_t {
  kPose,
  kLight,
  kMouthInterior,
  kBody,
  kGround,
  kMouth,  ///< this and the following: coefficients of GenericHead::expression, in its order
  kBrows,
  kUpperLids,
  kLowerLids,
  kGaze,
};
inline constexpr int kPartCount = 10;
[[nodiscard]] constexpr std::size_t index_of(PartId part) {
  return static_cast<std::size_t>(part);
}

/// Bit p for part p.
using PartMask = std::uint16_t;
inline constexpr PartMask kAllParts = (1 << kPartCount) - 1;
[[nodiscard]] constexpr PartMask mask_of(PartId part) {
  return static_cast<PartMask>(1U << index_of(part));
}

[[nodiscard]] constexpr bool has_part(PartMask parts, std::size_t part) {
  return (parts >> part & 1) != 0;
}

inline constexpr std::array<std::string_view, kPartCount> kPartNames = {
    "pose",  "light", "mouth interior", "body",       "ground",
    "mouth", "brows", "upper lids",     "lower lids", "gaze"};

/// Numbers of each part.
inline constexpr std::array<std::size_t, kPartCount> kPartSizes = {6, 7, 3, 4, 4, 36, 16, 8, 8, 4};
inline constexpr std::size_t kMaxPartSize = 36;

inline constexpr int kFirstExpressionPart = index_of(PartId::kMouth);

/// First number of each part.
inline constexpr std::array<std::size_t, kPartCount + 1> kPartFirst = [] {
  std::array<std::size_t, kPartCount + 1> first{};
  for (std::size_t p = 0; p < kPartCount; ++p) first[p + 1] = first[p] + kPartSizes[p];
  return first;
}();
inline constexpr int kParameterCount = kPartFirst[kPartCount];
inline constexpr int kFirstCoefficient = kPartFirst[kFirstExpressionPart];
static_assert(kParameterCount == 96 && kParameterCount - kFirstCoefficient == 2 * kControlCount);

[[nodiscard]] constexpr std::size_t first_of(PartId part) {
  return kPartFirst[index_of(part)];
}

/// Part of each number.
inline constexpr std::array<std::uint8_t, kParameterCount> kPartOf = [] {
  std::array<std::uint8_t, kParameterCount> part{};
  for (std::size_t p = 0; p < kPartCount; ++p)
    for (std::size_t i = kPartFirst[p]; i < kPartFirst[p + 1]; ++i) part[i] = static_cast<std::uint8_t>(p);
  return part;
}();

/// All numbers of a state in stream order, in steps: pose, light, mouth interior, body, ground, then the
/// coefficients of the expression's parts.
using CodedState = std::array<std::int32_t, kParameterCount>;

/// Step of each number.
[[nodiscard]] std::int32_t step_of(const QuantiserSteps& steps, std::size_t parameter);

/// The state with these values: numbers in the units of State, coefficients in head units.
[[nodiscard]] State state_of_values(const CodedState& values);

/// The state with these numbers in steps.
[[nodiscard]] State state_of(const CodedState& coded, const QuantiserSteps& steps);

/// Limits of the numbers that can be coded, in steps.
struct CodedLimits {
  CodedState min{};
  CodedState max{};
  PartMask parts;  ///< parts that are sent; numbers of the others are zero

  CodedLimits(const QuantiserSteps& steps, PartMask sent_parts);

  [[nodiscard]] bool hold(std::size_t parameter, std::int32_t number) const {
    return number >= min[parameter] && number <= max[parameter];
  }
  /// True when every number is within its limits.
  [[nodiscard]] bool hold(const CodedState& state) const;
};

}  // namespace fbs
