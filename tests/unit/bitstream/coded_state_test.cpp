#include "bitstream/coded_state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr QuantiserSteps kSteps{3, 5, 7, 11, 13};

TEST(CodedState, PartsAreThoseOfTheGenericHead) {
  for (std::size_t p = 0; p < kExpressionPartCount; ++p)
    EXPECT_EQ(kPartSizes[kFirstExpressionPart + p], 2 * generic_head().expression[p].control_count);
  EXPECT_EQ(*std::max_element(kPartSizes.begin(), kPartSizes.end()), kMaxPartSize);
  EXPECT_EQ(kPartOf.front(), static_cast<int>(PartId::kPose));
  EXPECT_EQ(kPartOf[kFirstCoefficient], static_cast<int>(PartId::kMouth));
  EXPECT_EQ(kPartOf[kFirstCoefficient - 1], static_cast<int>(PartId::kGround));
  EXPECT_EQ(kPartOf.back(), static_cast<int>(PartId::kGaze));
}

// SPEC 5.1
TEST(CodedState, EachNumberHasTheStepOfItsKind) {
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    const std::int32_t expected = i < 3                   ? kSteps.rotation
                                  : i < 5                 ? kSteps.translation
                                  : i == 5                ? kSteps.log_scale
                                  : i < 16                ? kSteps.light
                                  : i < kFirstCoefficient ? kSteps.translation
                                                          : kSteps.control;
    EXPECT_EQ(step_of(kSteps, i), expected) << i;
  }
}

TEST(CodedState, StateHasItsNumbersTimesTheSteps) {
  CodedState coded{};
  for (int i = 0; i < kFirstCoefficient; ++i) coded[i] = i - 4;
  const State s = state_of(coded, kSteps);
  EXPECT_EQ(s.pose, (std::array{-4 * 3, -3 * 3, -2 * 3, -1 * 5, 0, 1 * 7}));
  EXPECT_EQ(s.light, (std::array{2 * 11, 3 * 11, 4 * 11, 5 * 11, 6 * 11, 7 * 11, 8 * 11}));
  EXPECT_EQ(s.interior, (std::array{9 * 11, 10 * 11, 11 * 11}));
  EXPECT_EQ(s.body, (std::array{12 * 5, 13 * 5, 14 * 5, 15 * 5}));
  EXPECT_EQ(s.ground, (std::array{16 * 5, 17 * 5, 18 * 5, 19 * 5}));
  for (const glm::ivec2 c : s.control) EXPECT_EQ(c, glm::ivec2(0));
}

/// The control points of a state's coefficients, computed in doubles.
State plain_state(const CodedState& values) {
  State s;
  std::size_t first = kFirstCoefficient;
  for (const ExpressionPart& part : generic_head().expression) {
    const std::size_t n = 2 * part.control_count;
    for (std::size_t c = 0; c < n; ++c) {
      double sum = 0;
      for (std::size_t k = 0; k < n; ++k)
        sum += values[first + k] * (part.rows[k * n + c] / static_cast<double>(kSkinningOne));
      const double clamped = std::clamp<double>(std::floor(sum + 0.5), -kMaxControl, kMaxControl);
      s.control[part.first_control + c / 2][static_cast<int>(c % 2)] = static_cast<int>(clamped);
    }
    first += n;
  }
  return s;
}

TEST(CodedState, CoefficientsMoveTheControlPointsOfTheirPart) {
  std::mt19937 random(1);
  int clamped = 0, inside = 0;
  for (int i = 0; i < 300; ++i) {
    CodedState values{};
    const int reach = i % 3 == 0 ? 300 : i % 3 == 1 ? 4000 : 8 * kMaxControl;
    for (std::size_t k = kFirstCoefficient; k < kParameterCount; ++k)
      values[k] = static_cast<int>(random() % static_cast<unsigned>(2 * reach + 1)) - reach;
    const State state = state_of_values(values);
    ASSERT_EQ(state.control, plain_state(values).control) << i;
    for (const glm::ivec2 c : state.control) ++(std::abs(c.x) == kMaxControl ? clamped : inside);
  }
  EXPECT_GT(clamped, 500) << "both cases must occur";
  EXPECT_GT(inside, 500);
}

TEST(CodedState, OneCoefficientLeavesOtherPartsAlone) {
  for (std::size_t k = kFirstCoefficient; k < kParameterCount; ++k) {
    CodedState values{};
    values[k] = 1000;
    const State state = state_of_values(values);
    const ExpressionPart& part = generic_head().expression[kPartOf[k] - kFirstExpressionPart];
    int moved = 0;
    for (int c = 0; c < kControlCount; ++c) {
      if (state.control[c] == glm::ivec2(0)) continue;
      ++moved;
      EXPECT_TRUE(c >= part.first_control && c < part.first_control + part.control_count) << k << ' ' << c;
    }
    EXPECT_GT(moved, 0) << k;
  }
}

TEST(CodedLimits, AreThoseOfTheStateInWholeSteps) {
  const CodedLimits limits(kSteps, kAllParts);
  EXPECT_EQ(limits.max[kYaw], kMaxRotation / 3);
  EXPECT_EQ(limits.min[kYaw], -(kMaxRotation / 3));
  EXPECT_EQ(limits.max[kShiftY], kMaxTranslation / 5);
  EXPECT_EQ(limits.max[kLogScale], kMaxLogScale / 7);
  EXPECT_EQ(limits.min[kLogScale], 0) << "the eyes are never less than a pixel apart";
  EXPECT_EQ(limits.max[kPoseCount], kMaxLight / 11);
  EXPECT_EQ(limits.min[kPoseCount + kLightCount], -(kMaxLight / 11)) << "mouth interior";
  EXPECT_EQ(limits.min[kPoseCount + kLightCount + kInteriorCount], -(kMaxTranslation / 5));
  EXPECT_EQ(limits.max[kFirstCoefficient], 8 * kMaxControl / 13);
  for (std::size_t i = 0; i < kParameterCount; ++i) EXPECT_LE(limits.min[i], 0) << i;
}

TEST(CodedLimits, HoldUpToTheLimitAndNotBeyond) {
  const CodedLimits limits(kSteps, kAllParts);
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    CodedState s{};
    s[i] = limits.max[i];
    EXPECT_TRUE(limits.hold(s)) << i;
    ++s[i];
    EXPECT_FALSE(limits.hold(s)) << i;
    s[i] = limits.min[i];
    EXPECT_TRUE(limits.hold(s)) << i;
    --s[i];
    EXPECT_FALSE(limits.hold(s)) << i;
  }
}

TEST(CodedLimits, PartsThatAreNotSentStayZero) {
  const auto parts = static_cast<PartMask>(mask_of(PartId::kPose) | mask_of(PartId::kBrows));
  const CodedLimits limits(kSteps, parts);
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    CodedState s{};
    s[i] = 1;
    const bool sent =
        kPartOf[i] == static_cast<int>(PartId::kPose) || kPartOf[i] == static_cast<int>(PartId::kBrows);
    EXPECT_EQ(limits.hold(s), sent) << i;
  }
}

}  // namespace
}  // namespace fbs
