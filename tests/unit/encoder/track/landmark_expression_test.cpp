#include "encoder/track/landmark_expression.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/ibug.h"
#include "encoder/find/adapt.h"
#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

/// A talker whose true landmarks and poses are known.
class LandmarkExpressionTest : public testing::Test {
 protected:
  [[nodiscard]] Pose pose(int frame) { return adapt_head(clip_.marks(frame))->pose; }

  /// @param wrong  added to the mouth's landmarks, pixels
  [[nodiscard]] LandmarkPoints landmarks(int frame, glm::dvec2 wrong = {0, 0}) const {
    const Shape shape = clip_.shape(frame);
    LandmarkPoints out;
    for (std::size_t k = 0; k < kLandmarkCount; ++k)
      out[k] = glm::dvec2(shape[k]) + (k >= ibug::kMouthFirst ? wrong : glm::dvec2(0));
    return out;
  }

  /// Between the inner lips, eye distances.
  [[nodiscard]] double opening(const Offsets& offsets) const {
    const HeadVertices v = skinned(head_.geometry, offsets);
    return (v[vertex_of_landmark(ibug::kLowerLipInner)].y - v[vertex_of_landmark(ibug::kUpperLipInner)].y) /
           kUnitsPerEyeDistance;
  }
  [[nodiscard]] int widest() const {
    int best = 0;
    const auto gap = [&](int t) {
      const Shape s = clip_.shape(t);
      return s[ibug::kLowerLipInner].y - s[ibug::kUpperLipInner].y;
    };
    for (int t = 0; t < clip_.count(); ++t)
      if (gap(t) > gap(best)) best = t;
    return best;
  }

  TalkerClip clip_{talker_settings(264, 216, 90)};
  AdaptedHead head_ = *adapt_head(clip_.marks(0));
  LandmarkExpression expression_{head_.geometry};
};

TEST_F(LandmarkExpressionTest, AConstantErrorIsTakenOutByCalibration) {
  const glm::dvec2 wrong(3, 5);
  const int t = widest();
  EXPECT_FALSE(expression_.is_calibrated());
  expression_.calibrate(landmarks(0), head_.pose, Offsets{});
  EXPECT_TRUE(expression_.is_calibrated());
  const Offsets right = expression_.offsets(landmarks(t), pose(t));
  expression_.calibrate(landmarks(0, wrong), head_.pose, Offsets{});
  const Offsets corrected = expression_.offsets(landmarks(t, wrong), pose(t));
  for (std::size_t c = 0; c < kControlCount; ++c)
    EXPECT_LT(std::hypot(right[c].x - corrected[c].x, right[c].y - corrected[c].y),
              0.03 * kUnitsPerEyeDistance);
}

// The first row of a file need not be of the first picture.
TEST_F(LandmarkExpressionTest, CanBeCalibratedWhileTheMouthIsOpen) {
  const int t = widest();
  expression_.calibrate(landmarks(0), head_.pose, Offsets{});
  const Offsets open = expression_.offsets(landmarks(t), pose(t));
  ASSERT_GT(opening(open) - opening(Offsets{}), 0.15) << "the test needs an open mouth";
  expression_.calibrate(landmarks(t), pose(t), open);
  EXPECT_NEAR(opening(expression_.offsets(landmarks(0), pose(0))), opening(Offsets{}), 0.03);
  EXPECT_NEAR(opening(expression_.offsets(landmarks(t), pose(t))), opening(open), 0.03);
}

}  // namespace
}  // namespace fbs
