#include "encoder/plan/group_plan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/encoder/plan/flat_group.h"

namespace fbs {
namespace {

using Durations = std::vector<std::uint32_t>;

Setup setup_of() {
  Setup setup;
  setup.format.width = 176;
  setup.format.height = 144;
  setup.steps = kFlatSteps;
  return setup;
}

/// A head that shakes.
std::vector<PictureCost> shaking(int count) {
  auto pictures = flat_group(count, 40);
  for (std::size_t t = 0; t < pictures.size(); ++t)
    for (std::size_t i = 0; i < kPoseCount; ++i)
      pictures[t].fit[i] += 12 * std::sin(static_cast<double>(t * (i + 2))) * step_of(kFlatSteps, i);
  return pictures;
}

TEST(GroupDurations, AreEmptyWhereAllAreNominal) {
  EXPECT_EQ(group_durations(Durations{0, 0, 0}, 3000), Durations{});
  EXPECT_EQ(group_durations(Durations{0, 6000, 0}, 3000), (Durations{3000, 6000, 3000}));
}

TEST(GroupDurations, SumToSeconds) {
  EXPECT_DOUBLE_EQ(seconds_of(Durations{0, 6000, 0}, 3000), 12000 / 90000.0);
}

TEST(GroupPlan, FirstGroupIsAKeyGroupAndCanBeCoded) {
  const auto pictures = shaking(10);
  MotionEncoder coder(setup_of(), flat_anchor());
  const TrackPlanner planner(kFlatSteps, kAllParts);
  const TrackRate rate;
  const Durations durations(10, 0);
  const MotionGroup first = plan_group(planner, {coder, true, pictures, durations, 3000, rate}, 1);
  EXPECT_TRUE(first.key);
  ASSERT_TRUE(coder.encode(first));
  const MotionGroup second = plan_group(planner, {coder, false, pictures, durations, 3000, rate}, 1);
  EXPECT_FALSE(second.key);
  EXPECT_EQ(second.anchor, coder.anchor());
  EXPECT_EQ(second.first, 10);
  EXPECT_TRUE(coder.encode(second));
}

TEST(GroupPlan, IsWithinItsBitsAndLeavesTheCoderAsItWas) {
  const auto pictures = shaking(20);
  const MotionEncoder coder(setup_of(), flat_anchor());
  const TrackPlanner planner(kFlatSteps, kAllParts);
  const TrackRate rate;
  const Durations durations(20, 0);
  const GroupInput input{coder, coder.groups() == 0, pictures, durations, 3000, rate};
  double last = 0;
  for (const double allowed : {400.0, 800.0, 1600.0}) {
    const PlannedGroup planned = plan_group_within(planner, input, allowed, 1, 1);
    EXPECT_LE(planned.bits, allowed);
    EXPECT_GE(planned.bits, last);
    last = planned.bits;
    EXPECT_EQ(planned.group, plan_group(planner, input, planned.lambda));
    const auto payload = MotionEncoder(coder).encode(planned.group);
    ASSERT_TRUE(payload);
    EXPECT_EQ(planned.bits, 8.0 * static_cast<double>(payload->size() + 5)) << "with the packet around it";
  }
  EXPECT_GT(last, 400);
}

}  // namespace
}  // namespace fbs
