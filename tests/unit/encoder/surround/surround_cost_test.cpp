#include "encoder/surround/surround_cost.h"

#include <gtest/gtest.h>

#include "encoder/image/robust.h"
#include "tests/unit/encoder/surround/painted_surround.h"

namespace fbs {
namespace {

constexpr int kFactor = 2;
constexpr double kSquaredOutlier = 16 * 16;

cv::Mat work_luma(const Picture& picture) {
  return reduced(picture.y, kFactor);
}

/// Keypoints of the first picture without a body, all of them ground.
std::vector<Keypoint> ground_keypoints() {
  auto keypoints = select_keypoints(make_pyramid<kSurroundLevels>(work_luma(picture_of({}, 0, false))),
                                    kFactor, pose_of(seen_state()));
  for (Keypoint& k : keypoints) k.layers = LayerMembership(LayerShares{0, 0, 1});
  return keypoints;
}

double constant_of(const Picture& now, const LayerMotion& motion) {
  return surround_constant(ground_keypoints(), true, work_luma(now), kFactor, motion);
}

/// Samples of the full picture in the keypoints' squares.
double covered_samples() {
  return static_cast<double>(ground_keypoints().size()) * 16 * kFactor * kFactor;
}

Picture brightened(Picture picture, int by) {
  for (auto& s : picture.y.samples) s = static_cast<std::uint8_t>(s + by);
  return picture;
}

TEST(SurroundConstant, IsZeroInTheFirstPicture) {
  EXPECT_EQ(constant_of(picture_of({}, 0, false), {}), 0);
}

TEST(SurroundConstant, CountsSamplesOfTheFullPicture) {
  const Picture first = picture_of({}, 0, false);
  EXPECT_NEAR(constant_of(brightened(first, 5), {}) / covered_samples(), geman_mcclure(25.0, kSquaredOutlier),
              1e-6);
  EXPECT_LT(covered_samples(), kWidth * kHeight);
  EXPECT_GT(covered_samples(), 0.5 * kWidth * kHeight) << "else the paint is too flat for the test";
}

// Like the quadratic: the encoder weighs the difference of full pictures.
TEST(SurroundConstant, IsNearTheSquaredDifferenceOfThePictures) {
  const Picture first = picture_of({}, 0, false);
  for (const Similarity& by : {Similarity{0.7, 0, 0, 0}, {0, -0.7, 0, 0}, {0, 0, 0.15, 0}}) {
    const Picture now = picture_of({{}, {}, by}, 0, false);
    EXPECT_NEAR(constant_of(now, {}) / squares(now, first), 1, 0.35) << by[0] << ' ' << by[2];
  }
}

TEST(SurroundConstant, FallsToWhatTheRightMotionLeaves) {
  const Similarity by = {3.3, -2.1, 0, 0};
  const Picture now = picture_of({{}, {}, by}, 0, false);
  LayerMotion motion;
  motion.ground = by;
  EXPECT_LT(constant_of(now, motion), 0.1 * constant_of(now, {}));
}

TEST(SurroundConstant, IsBoundedByTheOutlierScale) {
  Picture inverse = picture_of({}, 0, false);
  for (auto& s : inverse.y.samples) s = static_cast<std::uint8_t>(255 - s);
  EXPECT_LT(constant_of(inverse, {}), kSquaredOutlier * covered_samples());
  EXPECT_GT(constant_of(inverse, {}), 0.3 * kSquaredOutlier * covered_samples());
}

TEST(SurroundConstant, SharesMoveAKeypointBetweenTheLayers) {
  LayerMotion motion;
  motion.body = {4, 0, 0, 0};
  motion.ground = {0, 2, 0, 0};
  const Keypoint keypoint = ground_keypoints().front();
  const glm::dvec2 by = motion.displacement_of(keypoint, {0.5F, 0.25F, 0.25F});
  EXPECT_NEAR(by.x, 1, 1e-9);
  EXPECT_NEAR(by.y, 0.5, 1e-9);
}

TEST(SurroundQuadratic, IsZeroForWhatIsNotSeen) {
  auto keypoints = ground_keypoints();
  EXPECT_EQ(cv::countNonZero(surround_quadratic(keypoints, true)), 0) << "no picture was observed";
  for (Keypoint& k : keypoints) k.layers.observe(kGroundLayer, 0, 1);
  EXPECT_GT(cv::countNonZero(surround_quadratic(keypoints, true)), 0);
}

}  // namespace
}  // namespace fbs
