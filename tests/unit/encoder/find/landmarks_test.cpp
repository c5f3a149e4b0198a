#include "encoder/find/landmarks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "encoder/landmarks/shape.h"

namespace fbs {
namespace {

TEST(Landmarks, EyesOfTheGenericHeadAreOneApartAndAtDepthZero) {
  glm::dvec3 right(0), left(0);
  for (int k = 0; k < ibug::kEyePoints; ++k) {
    right += generic_landmark(ibug::kEyesFirst + k) / 6.0;
    left += generic_landmark(ibug::kEyesFirst + ibug::kEyePoints + k) / 6.0;
  }
  EXPECT_NEAR(left.x - right.x, 1, 0.02);
  EXPECT_NEAR(right.z + left.z, 0, 1e-9);
}

TEST(Landmarks, NamesAreWhereTheySay) {
  EXPECT_GT(generic_landmark(ibug::kChin).y, generic_landmark(ibug::kLowerLipBottom).y);
  EXPECT_GT(generic_landmark(ibug::kLowerLipBottom).y, generic_landmark(ibug::kLowerLipInner).y);
  EXPECT_GE(generic_landmark(ibug::kLowerLipInner).y, generic_landmark(ibug::kUpperLipInner).y);
  EXPECT_GT(generic_landmark(ibug::kUpperLipInner).y, generic_landmark(ibug::kUpperLipTop).y);
  EXPECT_GT(generic_landmark(ibug::kUpperLipTop).y, generic_landmark(ibug::kNoseBase).y);
  EXPECT_GT(generic_landmark(ibug::kNoseBase).y, generic_landmark(ibug::kNoseTip).y);
  EXPECT_LT(generic_landmark(ibug::kRightEyeOuter).x, generic_landmark(ibug::kRightEyeInner).x);
  EXPECT_LT(generic_landmark(ibug::kLeftEyeInner).x, generic_landmark(ibug::kLeftEyeOuter).x);
  EXPECT_LT(generic_landmark(ibug::kMouthRight).x, generic_landmark(ibug::kMouthLeft).x);
  EXPECT_LT(generic_landmark(ibug::kNoseTip).z, 0) << "in front of the eyes";
  for (const int k : {ibug::kRightLowerLid, ibug::kLeftLowerLid})
    EXPECT_GT(generic_landmark(k).y, generic_landmark(ibug::kRightEyeOuter).y - 0.01);
}

TEST(Landmarks, AreMirrored) {
  for (int k = 0; k < kLandmarkCount; ++k)
    EXPECT_NEAR(generic_landmark(mirrored_landmark(k)).x, -generic_landmark(k).x, 0.01) << k;
}

TEST(Landmarks, TwelveAreOfTheEyes) {
  int eyes = 0;
  for (int k = -1; k < kLandmarkCount; ++k) eyes += is_eye_landmark(k) ? 1 : 0;
  EXPECT_EQ(eyes, 12);
  EXPECT_FALSE(is_eye_landmark(-1));
}

}  // namespace
}  // namespace fbs
