#include "encoder/surround/similarity.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

TEST(Similarity, DisplacementOfEveryPlaceIsThatOfTheOriginWithoutScaleAndRotation) {
  const Similarity s = {3, -2, 0, 0};
  EXPECT_EQ(displacement(s, {0, 0}), glm::dvec2(3, -2));
  EXPECT_EQ(displacement(s, {5, 7}), glm::dvec2(3, -2));
}

// One eye distance right of the origin, scale moves right and rotation down: clockwise, y points down.
TEST(Similarity, ScaleAndRotationMoveAPlaceOneEyeDistanceAway) {
  EXPECT_EQ(displacement({0, 0, 2, 0}, {1, 0}), glm::dvec2(2, 0));
  EXPECT_EQ(displacement({0, 0, 2, 0}, {0, 1}), glm::dvec2(0, 2));
  EXPECT_EQ(displacement({0, 0, 0, 2}, {1, 0}), glm::dvec2(0, 2));
  EXPECT_EQ(displacement({0, 0, 0, 2}, {0, 1}), glm::dvec2(-2, 0));
}

TEST(Similarity, StateCountsSixtyFourthsOfAPixel) {
  EXPECT_EQ(to_state(1), 64);
  EXPECT_EQ(to_state(-0.5), -32);
  EXPECT_EQ(to_state(0.009), 1);
}

}  // namespace
}  // namespace fbs
