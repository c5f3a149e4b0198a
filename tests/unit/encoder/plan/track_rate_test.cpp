#include "encoder/plan/track_rate.h"

#include <gtest/gtest.h>

#include <numeric>

#include "bitstream/motion/motion_encoder.h"
#include "tests/unit/bitstream/random_tracks.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr auto kPose = static_cast<std::size_t>(PartId::kPose);

/// A group in which each picture has a knot of the pose and yaw moves by `change` in each.
MotionGroup yaw_group(std::int32_t pictures, std::int32_t change) {
  MotionGroup group;
  group.pictures = pictures;
  for (std::int32_t t = 0; t < pictures; ++t) {
    Knot knot{.picture = t, .value = {}};
    knot.value[kYaw] = change * (t + 1);
    group.tracks[kPose].push_back(knot);
  }
  return group;
}

TEST(TrackRate, LargerChangesCostMoreAndEitherSignTheSame) {
  const TrackRate rate;
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    EXPECT_GT(rate.change(i, 0), 0);
    EXPECT_GT(rate.change(i, 1), rate.change(i, 0)) << i;
    for (int m = 1; m < 200; ++m) {
      EXPECT_EQ(rate.change(i, m), rate.change(i, -m));
      EXPECT_GE(rate.change(i, m + 1), rate.change(i, m)) << i << ' ' << m;
    }
    EXPECT_LT(rate.change(i, 1 << 20), 80) << "of an Exp-Golomb number, not a unary one";
  }
}

TEST(TrackRate, ExpectsTheFirstCoefficientsOfAPartToChangeMost) {
  const TrackRate rate;
  const auto first = static_cast<std::size_t>(kFirstCoefficient);
  EXPECT_LT(rate.change(first, 2), rate.change(first + 20, 2));
  EXPECT_GT(rate.change(first, 0), rate.change(first + 20, 0));
}

TEST(TrackRate, KnotCostsItsSpanAndItsChanges) {
  const TrackRate rate;
  Knot from{.picture = 2, .value = {}}, to{.picture = 7, .value = {}};
  EXPECT_EQ(rate.knot(kPose, from, to, 20), rate.span(kPose, false, false));
  EXPECT_EQ(rate.knot(kPose, from, to, 8), rate.span(kPose, false, true));
  to.value[kYaw] = 3;
  to.value[kLogScale] = -1;
  double expected = rate.span(kPose, true, false);
  for (std::size_t i = 0; i < kPoseCount; ++i)
    expected += rate.change(i, i == kYaw ? 3 : i == kLogScale ? -1 : 0);
  EXPECT_DOUBLE_EQ(rate.knot(kPose, from, to, 20), expected);
}

TEST(TrackRate, LearnsWhatChangesAndHowFar) {
  const TrackRate fresh;
  TrackRate rate;
  for (int g = 0; g < 4; ++g) rate.learn(yaw_group(10, 9));
  EXPECT_LT(rate.change(kYaw, 9), fresh.change(kYaw, 9));
  EXPECT_GT(rate.change(kYaw, 0), fresh.change(kYaw, 0));
  EXPECT_LT(rate.change(kPitch, 0), fresh.change(kPitch, 0)) << "never moved";
  EXPECT_GT(rate.change(kPitch, 1), fresh.change(kPitch, 1));
  EXPECT_LT(rate.span(kPose, true, false), fresh.span(kPose, true, false)) << "short spans that move";
  EXPECT_GT(rate.span(kPose, false, true), fresh.span(kPose, false, true));
  EXPECT_EQ(rate.change(kFirstCoefficient, 1), fresh.change(kFirstCoefficient, 1))
      << "nothing was seen of it";
}

TEST(TrackRate, ForgetsOlderGroups) {
  TrackRate moved, still;
  for (int g = 0; g < 5; ++g) moved.learn(yaw_group(10, 9));
  EXPECT_LT(moved.change(kYaw, 9), still.change(kYaw, 9) - 3);
  for (int g = 0; g < 40; ++g) {
    moved.learn(yaw_group(10, 1));
    still.learn(yaw_group(10, 1));
  }
  EXPECT_NEAR(moved.change(kYaw, 9), still.change(kYaw, 9), 0.05);
}

double estimated(const TrackRate& rate, const MotionGroup& group) {
  double bits = 0;
  for (std::size_t part = 0; part < kPartCount; ++part) {
    Knot last{.picture = -1, .value = {}};
    std::copy_n(group.anchor.begin() + kPartFirst[part], kPartSizes[part], last.value.begin());
    for (const Knot& knot : group.tracks[part]) {
      bits += rate.knot(part, last, knot, group.pictures);
      last = knot;
    }
  }
  return bits;
}

TEST(TrackRate, IsNearWhatTheCoderWrites) {
  const auto setup = toy_setup();
  for (const TrackHabits habits : {TrackHabits{.knot_one_in = 4, .moves_one_in = 2, .reach = 2},
                                   TrackHabits{.knot_one_in = 2, .moves_one_in = 1, .reach = 6},
                                   TrackHabits{.knot_one_in = 10, .moves_one_in = 3, .reach = 1}}) {
    CodedState seen{};
    seen[kLogScale] = 5 * 4096;
    MotionEncoder coder(setup, seen);
    TrackRate rate;
    std::mt19937 random(4);
    double guessed = 0, written = 0;
    for (int g = 0; g < 12; ++g) {
      MotionGroup group = random_group(random, coder.limits(), coder.anchor(), 30, habits);
      group.key = coder.groups() == 0;
      group.first = coder.next();
      const auto payload = coder.encode(group);
      ASSERT_TRUE(payload);
      if (g >= 4) {  // both have learned
        guessed += estimated(rate, group);
        written += 8 * static_cast<double>(payload->size());
      }
      rate.learn(group);
    }
    EXPECT_NEAR(guessed / written, 1, 0.2) << habits.reach;
  }
}

}  // namespace
}  // namespace fbs
