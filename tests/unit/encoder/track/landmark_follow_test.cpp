#include "encoder/track/landmark_follow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/ibug.h"
#include "encoder/find/adapt.h"
#include "encoder/image/planes.h"
#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

/// A talker whose first picture is known with true marks, and later pictures with true poses.
class LandmarkFollowTest : public testing::Test {
 protected:
  [[nodiscard]] Pose pose(int frame) { return adapt_head(clip_.marks(frame))->pose; }

  [[nodiscard]] std::optional<Offsets> found(int frame) {
    return follow_.find(view(clip_[frame].y), pose(frame), Offsets{});
  }

  /// Between the inner lips, eye distances.
  [[nodiscard]] double opening(const Offsets& offsets) const {
    const HeadVertices v = skinned(head_.geometry, offsets);
    return (v[vertex_of_landmark(ibug::kLowerLipInner)].y - v[vertex_of_landmark(ibug::kUpperLipInner)].y) /
           kUnitsPerEyeDistance;
  }
  [[nodiscard]] double true_opening(int frame) const {
    const Shape shape = clip_.shape(frame);
    return static_cast<double>(shape[ibug::kLowerLipInner].y - shape[ibug::kUpperLipInner].y) /
           static_cast<double>(eye_distance(shape));
  }

  TalkerClip clip_{talker_settings(264, 216, 150)};
  AdaptedHead head_ = *adapt_head(clip_.marks(0));
  LandmarkSearch search_{*load_landmarks()};
  LandmarkFollow follow_{&search_, head_.geometry, head_.pose, view(clip_[0].y)};
};

TEST_F(LandmarkFollowTest, AFaceAtRestIsAtRest) {
  const auto offsets = found(0);
  ASSERT_TRUE(offsets);
  for (const glm::dvec2& o : *offsets) EXPECT_LT(std::hypot(o.x, o.y), 0.02 * kUnitsPerEyeDistance);
}

TEST_F(LandmarkFollowTest, SeesHowFarTheMouthIsOpenWhateverCameBefore) {
  double worst = 0, widest = 0;
  for (int t = 0; t < clip_.count(); t += 10) {
    const auto offsets = found(t);
    ASSERT_TRUE(offsets) << t;
    const double truth = true_opening(t) - true_opening(0), seen = opening(*offsets) - opening(Offsets{});
    worst = std::max(worst, std::abs(seen - truth));
    widest = std::max(widest, truth);
  }
  EXPECT_GT(widest, 0.15) << "the test needs an open mouth";
  EXPECT_LT(worst, 0.08);
}

TEST_F(LandmarkFollowTest, PupilsStayAtRest) {
  const auto offsets = found(20);
  ASSERT_TRUE(offsets);
  for (const FeatureId id : {FeatureId::kPupilRight, FeatureId::kPupilLeft})
    EXPECT_EQ((*offsets)[feature(id).first_control], glm::dvec2(0));
}

TEST_F(LandmarkFollowTest, FindsNothingWhereNoFaceIs) {
  EXPECT_FALSE(follow_.find(cv::Mat1b(216, 264, std::uint8_t{100}), head_.pose, Offsets{}));
}

}  // namespace
}  // namespace fbs
