#include "encoder/track/snake/inner_lip_follow.h"

#include <gtest/gtest.h>

#include "common/generic_head.h"

namespace fbs {
namespace {

TEST(InnerLipFollow, HasARowForEachInnerControlPoint) {
  ASSERT_EQ(inner_lip_follow().size(), feature(FeatureId::kMouthInner).control_count);
  for (const auto& row : inner_lip_follow())
    EXPECT_EQ(row.size(), feature(FeatureId::kMouthOuter).control_count);
}

// Outer lips that move as one take the inner ones along, if not all the way.
TEST(InnerLipFollow, InnerLipsGoWithTheOuterOnes) {
  for (const auto& row : inner_lip_follow()) {
    double sum = 0;
    for (const double share : row) sum += share;
    EXPECT_GT(sum, 0.3);
    EXPECT_LT(sum, 1.5);
  }
}

// Both curves run from the right corner over the upper lip.
TEST(InnerLipFollow, EachLipFollowsItsOwnSide) {
  const auto& follow = inner_lip_follow();
  const std::size_t inner = follow.size(), outer = follow[0].size();
  EXPECT_GT(follow[inner / 4][outer / 4], follow[inner / 4][outer * 3 / 4]) << "upper lip";
  EXPECT_GT(follow[inner * 3 / 4][outer * 3 / 4], follow[inner * 3 / 4][outer / 4]) << "lower lip";
}

}  // namespace
}  // namespace fbs
