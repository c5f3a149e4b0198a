#include "bitstream/track.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr QuantiserSteps kFinest{1, 1, 1, 1, 1};

TEST(Interpolate, BeginsAndEndsExactly) {
  for (const int from : {-1000, -1, 0, 7}) {
    for (const int to : {-999, 0, 3, 1 << 20}) {
      for (const int length : {1, 2, 7, 256}) {
        EXPECT_EQ(interpolate(from, to, 0, length), from);
        EXPECT_EQ(interpolate(from, to, length, length), to);
      }
    }
  }
}

// SPEC 5.2. Halves go up on both sides of zero, so that motion there and back are rounded differently.
TEST(Interpolate, RoundsHalvesUp) {
  EXPECT_EQ(interpolate(0, 1, 1, 2), 1);
  EXPECT_EQ(interpolate(0, -1, 1, 2), 0);
  EXPECT_EQ(interpolate(-1, 0, 1, 2), 0);
  EXPECT_EQ(interpolate(-3, -2, 1, 2), -2);
  EXPECT_EQ(interpolate(0, -3, 1, 2), -1);
  EXPECT_EQ(interpolate(0, 1, 1, 3), 0);
  EXPECT_EQ(interpolate(0, -1, 1, 3), 0);
  EXPECT_EQ(interpolate(0, -2, 1, 3), -1);
}

TEST(Interpolate, IsTheNearestIntegerToTheStraightLine) {
  std::mt19937 random(1);
  const auto number = [&] { return static_cast<int>(random() % 4001) - 2000; };
  for (int i = 0; i < 20000; ++i) {
    const int from = number(), to = number(), length = 1 + static_cast<int>(random() % 256),
              elapsed = static_cast<int>(random() % static_cast<unsigned>(length + 1));
    const double exact = from + (to - from) * (elapsed / static_cast<double>(length));
    ASSERT_NEAR(interpolate(from, to, elapsed, length), exact, 0.5 + 1e-9);
    // A shift of both ends shifts the result.
    ASSERT_EQ(interpolate(from + 5000, to + 5000, elapsed, length),
              interpolate(from, to, elapsed, length) + 5000);
  }
}

TEST(Interpolate, HoldsTheLargestNumbers) {
  EXPECT_EQ(interpolate(kMaxTranslation, -kMaxTranslation, 128, 256), 0);
  EXPECT_EQ(interpolate(INT32_MIN, INT32_MAX, 1, 2), 0);
}

/// A group in which only the pose is sent, with knots of yaw.
MotionGroup yaw_group(std::int32_t pictures, std::initializer_list<std::pair<int, int>> knots) {
  MotionGroup group;
  group.pictures = pictures;
  for (const auto& [picture, yaw] : knots) {
    Knot knot{.picture = picture, .value = {}};
    knot.value[kYaw] = yaw;
    group.tracks[0].push_back(knot);
  }
  return group;
}

std::vector<int> yaws(const std::vector<State>& states) {
  std::vector<int> out;
  for (const State& s : states) out.push_back(s.pose[kYaw]);
  return out;
}

TEST(StatesOf, AreLinearFromKnotToKnot) {
  MotionGroup group = yaw_group(6, {{1, 10}, {2, -2}, {5, 4}});
  EXPECT_EQ(yaws(states_of(group, kFinest)), (std::vector{5, 10, -2, 0, 2, 4}));
  group.anchor[kYaw] = 20;
  EXPECT_EQ(yaws(states_of(group, kFinest)), (std::vector{15, 10, -2, 0, 2, 4}));
}

// Interpolated values are not whole steps: a coarse quantiser does not make the motion jerky.
TEST(StatesOf, AreLinearInUnitsOfTheStateAndNotInSteps) {
  const QuantiserSteps coarse{100, 1, 1, 1, 1};
  EXPECT_EQ(yaws(states_of(yaw_group(4, {{3, 1}}), coarse)), (std::vector{25, 50, 75, 100}));
}

TEST(StatesOf, PartsHaveTheirOwnKnots) {
  MotionGroup group = yaw_group(4, {{3, 8}});
  const std::size_t light = index_of(PartId::kLight), gaze = index_of(PartId::kGaze);
  group.anchor[kPoseCount] = 4;
  group.tracks[light] = {{0, {0}}, {3, {3}}};
  group.tracks[gaze] = {{3, {4096}}};
  const auto states = states_of(group, kFinest);
  EXPECT_EQ(yaws(states), (std::vector{2, 4, 6, 8}));
  for (int t = 0; t < 4; ++t) EXPECT_EQ(states[t].light[kLightOffset], t);
  CodedState a_quarter{}, whole{};
  a_quarter[kPartFirst[gaze]] = 1024;
  whole[kPartFirst[gaze]] = 4096;
  EXPECT_EQ(states[0].control, state_of_values(a_quarter).control);
  EXPECT_EQ(states[3].control, state_of_values(whole).control);
}

// SPEC 6.2
TEST(StatesOf, MotionGoesOnThroughMissingPictures) {
  MotionGroup group = yaw_group(4, {{3, 16}});
  group.missing = 4;
  EXPECT_EQ(yaws(states_of(group, kFinest)), (std::vector{2, 4, 6, 8, 10, 12, 14, 16}));
  group = yaw_group(2, {{0, 33}, {1, 5}});
  group.missing = kMaxBridged + 3;
  const auto bridged = yaws(states_of(group, kFinest));
  ASSERT_EQ(bridged.size(), kMaxBridged + 5U);
  for (int t = 0; t < kMaxBridged + 4; ++t) EXPECT_EQ(bridged[t], std::max(0, t - 2)) << "held, then linear";
  EXPECT_EQ(bridged.back(), 5);
}

TEST(DurationsOf, MissingPicturesShareTheirTime) {
  MotionGroup group = yaw_group(2, {{1, 0}});
  const Rational rate{30, 1};
  EXPECT_EQ(durations_of(group, rate), (std::vector<std::uint32_t>{3000, 3000}));
  group.durations = {5, 6};
  EXPECT_EQ(durations_of(group, rate), (std::vector<std::uint32_t>{5, 6}));
  group.missing = 3;
  group.missing_time = 10;
  EXPECT_EQ(durations_of(group, rate), (std::vector<std::uint32_t>{3, 3, 4, 5, 6}));
  group.durations.clear();
  EXPECT_EQ(durations_of(group, rate), (std::vector<std::uint32_t>{3, 3, 4, 3000, 3000}));
}

TEST(KnotsEverywhere, GiveTheStatesTheyWereMadeFrom) {
  std::mt19937 random(2);
  const QuantiserSteps steps{3, 5, 7, 11, 13};
  for (const PartMask parts : {kAllParts, PartMask{1}, PartMask{0x111}}) {
    const CodedLimits limits(steps, parts);
    std::vector<CodedState> coded;
    for (int t = 0; t < 9; ++t) coded.push_back(random_coded(random, limits));
    const MotionGroup group = knots_everywhere(random_coded(random, limits), coded, parts);
    EXPECT_FALSE(group.key);
    const auto states = states_of(group, steps);
    ASSERT_EQ(states.size(), coded.size());
    for (std::size_t t = 0; t < coded.size(); ++t) EXPECT_EQ(states[t], state_of(coded[t], steps));
    EXPECT_EQ(last_of(group), coded.back());
    for (std::size_t p = 0; p < kPartCount; ++p)
      EXPECT_EQ(group.tracks[p].size(), has_part(parts, p) ? coded.size() : 0);
  }
}

TEST(LastOf, IsTheLastKnotOfEachPart) {
  MotionGroup group = yaw_group(6, {{1, 10}, {5, 4}});
  group.tracks[1] = {{5, {1, 2, 3, 4, 5, 6, 7}}};
  CodedState expected{};
  expected[kYaw] = 4;
  for (std::size_t k = 0; k < kLightCount; ++k) expected[kPoseCount + k] = static_cast<int>(k) + 1;
  EXPECT_EQ(last_of(group), expected);
}

}  // namespace
}  // namespace fbs
