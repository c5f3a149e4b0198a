#include "encoder/track/head/levelled_frame.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

WorkFrame cut(const Picture& picture) {
  return WorkFrame::cut(picture, {160, 110}, 48, false);
}

Picture smooth_picture() {
  Picture out(320, 240);
  out.y = smooth_plane(320, 240, 4);
  return out;
}

TEST(LevelledFrame, FlatIsTheMiddle) {
  Picture flat(320, 240);
  for (auto& s : flat.y.samples) s = 200;
  const LevelledFrame levelled(cut(flat));
  for (const cv::Mat& level : levelled.levels) EXPECT_EQ(cv::countNonZero(level != 128), 0);
}

TEST(LevelledFrame, ALampsGainOffsetAndSlopeAreTakenOut) {
  const Picture picture = smooth_picture();
  Picture lit = picture;
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x)
      lit.y.row(y)[x] = static_cast<std::uint8_t>(40 + 0.45 * picture.y.row(y)[x] + 0.2 * x);
  const LevelledFrame a(cut(picture)), b(cut(lit));
  EXPECT_GT(cv::mean(cv::abs(a.frame.luma - b.frame.luma))[0], 20);
  cv::Mat difference;
  cv::absdiff(a.levels[0], b.levels[0], difference);
  EXPECT_LT(cv::mean(difference)[0], 4);
}

TEST(LevelProjection, IsThePosesOnEveryLevel) {
  const LevelledFrame levelled(cut(smooth_picture()));
  Pose pose;
  pose.yaw = 0.3;
  pose.roll = -0.1;
  pose.shift = {150, 112};
  pose.log2_scale = 5.5;
  const PoseProjection projection(pose);
  for (int level = 0; level < LevelledFrame::kLevels; ++level) {
    const LevelProjection to_level(projection, levelled.frame, level);
    for (const glm::dvec3 p : {glm::dvec3(0), {2000, -1500, 700}, {-3000, 4000, -900}}) {
      const glm::dvec2 wanted = levelled.at(projection(p), level), found(to_level(glm::vec3(p)));
      EXPECT_NEAR(found.x, wanted.x, 1e-3);
      EXPECT_NEAR(found.y, wanted.y, 1e-3);
    }
  }
}

}  // namespace
}  // namespace fbs
