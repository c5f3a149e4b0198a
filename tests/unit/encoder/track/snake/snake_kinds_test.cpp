#include "encoder/track/snake/snake_kinds.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

TEST(SnakeKinds, LeftAndRightAreFollowedAlike) {
  EXPECT_EQ(&kind_of(FeatureId::kBrowRight), &kind_of(FeatureId::kBrowLeft));
  EXPECT_EQ(&kind_of(FeatureId::kUpperLidRight), &kind_of(FeatureId::kUpperLidLeft));
  EXPECT_NE(&kind_of(FeatureId::kMouthOuter), &kind_of(FeatureId::kMouthInner));
}

// Facing points of a closed curve are h and points - h; the quads of four want no more.
TEST(SnakeKinds, ClosedCurvesHaveAnEvenNumberOfPoints) {
  for (const FeatureId id : {FeatureId::kMouthOuter, FeatureId::kMouthInner})
    EXPECT_EQ(kind_of(id).points % 2, 0);
}

TEST(SnakeKinds, LidsDoNotRepel) {
  EXPECT_EQ(kind_of(FeatureId::kUpperLidRight).weights.repulsion, 0);
  EXPECT_GT(kind_of(FeatureId::kMouthInner).weights.repulsion,
            kind_of(FeatureId::kMouthOuter).weights.repulsion);
}

TEST(SnakeUnits, AreAThirtySecondOfTheEyeDistance) {
  EXPECT_EQ(kHeadUnitsPerSnakeUnit, 128);
}

}  // namespace
}  // namespace fbs
