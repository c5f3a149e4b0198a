#include "encoder/track/head/coarse_search.h"

#include <gtest/gtest.h>

#include "tests/unit/encoder/track/head/head_case.h"

namespace fbs {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

TEST(CoarseSearch, FindsThePlaceOfTheHead) {
  HeadCase c(1);
  const LevelledFrame now(c.frame(0));
  Pose start = c.head.pose;
  start.shift += glm::dvec2(0.5, -0.4) * start.eye_distance_px();
  const TrackedPose found =
      CoarseCorrelation(c.appearance, c.neutral, now).best_place(start, start.eye_distance_px());
  EXPECT_LT(shift_between(found.pose, c.head.pose), 0.12);
  EXPECT_GT(found.confidence, 0.7);
}

TEST(CoarseSearch, LikeliestOfTheGridComesFirst) {
  HeadCase c(1);
  constexpr std::array kYaw = {-30 * kDegree, 0.0, 30 * kDegree}, kPitch = {0.0, 15 * kDegree, -15 * kDegree},
                       kSize = {-0.3, 0.0, 0.3};
  const auto found = search_coarsely(c.appearance, c.neutral, LevelledFrame(c.frame(0)), c.head.pose,
                                     {kYaw, kPitch, kSize, 0.5});
  ASSERT_EQ(found.size(), 27U);
  EXPECT_NEAR(found[0].pose.yaw, c.head.pose.yaw, 1e-12);
  EXPECT_NEAR(found[0].pose.log2_scale, c.head.pose.log2_scale, 1e-12);
  for (std::size_t i = 1; i < found.size(); ++i) EXPECT_LE(found[i].confidence, found[i - 1].confidence);
}

TEST(CoarseSearch, NothingResemblesTheHeadInAFlatPicture) {
  HeadCase c(1);
  const LevelledFrame flat(WorkFrame::cut(Picture(352, 288), c.head.pose.shift, 40, false));
  const TrackedPose found = CoarseCorrelation(c.appearance, c.neutral, flat).best_place(c.head.pose, 20);
  EXPECT_EQ(found.confidence, 0);
}

}  // namespace
}  // namespace fbs
