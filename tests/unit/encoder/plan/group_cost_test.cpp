#include "encoder/plan/group_cost.h"

#include <gtest/gtest.h>

#include "tests/unit/encoder/plan/flat_group.h"

namespace fbs {
namespace {

constexpr auto kMouth = static_cast<std::size_t>(PartId::kMouth);

TEST(GroupCost, CountsInSteps) {
  auto pictures = flat_group(2, 3);
  pictures[1].fit[kYaw] = 5 * kFlatSteps.rotation;
  const GroupCost cost(pictures, {}, flat_steps());
  EXPECT_EQ(cost.pictures(), 2);
  EXPECT_DOUBLE_EQ(cost.target(1)[kYaw], 5);
  PartPoint pose{};
  pose[kLogScale] = 320;
  EXPECT_FLOAT_EQ(static_cast<float>(cost.distortion(0, 1, pose)), 3 * 5 * 5);
  pose[kYaw] = 4;
  EXPECT_FLOAT_EQ(static_cast<float>(cost.distortion(0, 1, pose)), 3);
}

TEST(GroupCost, AddsThePenaltyToEachPicture) {
  cv::Mat1d penalty = cv::Mat1d::zeros(kParameterCount, kParameterCount);
  const int c = kFirstCoefficient;
  penalty(c, c) = 2.0 / (kFlatSteps.control * kFlatSteps.control);
  PartPoint one{};
  one[0] = 1;
  const auto pictures = flat_group(1, 3);
  EXPECT_FLOAT_EQ(static_cast<float>(GroupCost(pictures, {}, flat_steps()).distortion(kMouth, 0, one)), 3);
  EXPECT_FLOAT_EQ(static_cast<float>(GroupCost(pictures, penalty, flat_steps()).distortion(kMouth, 0, one)),
                  5);
}

TEST(GroupCost, RoundsToTheNearestStepWithinTheLimits) {
  auto pictures = flat_group(1, 1);
  pictures[0].fit[kPitch] = 2.6 * kFlatSteps.rotation;
  pictures[0].fit[kYaw] = -1e9;
  const CodedLimits limits(kFlatSteps, kAllParts);
  const PartValues rounded = GroupCost(pictures, {}, flat_steps()).rounded(0, 0, limits);
  EXPECT_EQ(rounded[kPitch], 3);
  EXPECT_EQ(rounded[kYaw], limits.min[kYaw]);
}

TEST(GroupCost, LineRunsThroughBothEnds) {
  PartValues from{}, to{};
  from[0] = -4;
  to[0] = 8;
  EXPECT_EQ(on_line(from, to, 0, 0)[0], -4);
  EXPECT_EQ(on_line(from, to, 0, 0.25)[0], -1);
  EXPECT_EQ(on_line(from, to, 0, 1)[0], 8);
}

}  // namespace
}  // namespace fbs
