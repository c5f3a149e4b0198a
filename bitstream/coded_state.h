// The state as the stream codes it: one row of integers in quantiser steps, divided into parts. SPEC 5.1.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "common/state.h"

namespace fbs {

/// What is coded together, and moves between the same pictures.
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

/// Bit p for part p.
using PartMask = std::uint16_t;
inline constexpr PartMask kAllParts = (1 << kPartCount) - 1;
[[nodiscard]] constexpr PartMask mask_of(PartId part) {
  return static_cast<PartMask>(1U << static_cast<unsigned>(part));
}

inline constexpr std::array<std::string_view, kPartCount> kPartNames = {
    "pose",  "light", "mouth interior", "body",       "ground",
    "mouth", "brows", "upper lids",     "lower lids", "gaze"};

/// Numbers of each part.
inline constexpr std::array<std::size_t, kPartCount> kPartSizes = {6, 7, 3, 4, 4, 36, 16, 8, 8, 4};
inline constexpr std::size_t kMaxPartSize = 36;

inline constexpr int kFirstExpressionPart = static_cast<int>(PartId::kMouth);

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
  return kPartFirst[static_cast<std::size_t>(part)];
}

/// Part of each number.
inline constexpr std::array<std::uint8_t, kParameterCount> kPartOf = [] {
  std::array<std::uint8_t, kParameterCount> part{};
  for (std::size_t p = 0; p < kPartCount; ++p)
    for (std::size_t i = kPartFirst[p]; i < kPartFirst[p + 1]; ++i) part[i] = static_cast<std::uint8_t>(p);
  return part;
}();

/// All numbers of a state in stream order, in steps: pose, light, inside, body, ground, then the coefficients
/// of the expression's parts.
using CodedState = std::array<std::int32_t, kParameterCount>;

/// Step of each number.
[[nodiscard]] std::int32_t step_of(const QuantiserSteps& steps, std::size_t parameter);

/// The state whose numbers, in the units of State and for coefficients in head units, are `values`.
[[nodiscard]] State state_of_values(const CodedState& values);

/// The state that is coded as `coded`.
[[nodiscard]] State state_of(const CodedState& coded, const QuantiserSteps& steps);

/// What numbers may be coded, in steps.
struct CodedLimits {
  CodedState least{};
  CodedState most{};
  PartMask parts = kAllParts;  ///< that are sent; the others stay zero

  CodedLimits(const QuantiserSteps& steps, PartMask parts);

  /// True when every number is within its limits and those of parts not sent are zero.
  [[nodiscard]] bool hold(const CodedState& state) const;
};

}  // namespace fbs
