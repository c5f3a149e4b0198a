// One feature's snake: its patch moves with the head, its image holds the input of eq. 7 and 8.
#include "encoder/track/snake/feature_snake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "encoder/find/adapt.h"
#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

/// The mouth of a talker's first picture.
struct Mouth {
  TalkerClip clip{[] {
    auto settings = talker_settings(176, 144, 4);
    settings.eye_distance = 0.2F;
    return settings;
  }()};
  AdaptedHead head = *adapt_head(clip.marks(0));
  FeatureSnake snake = FeatureSnake::make(FeatureId::kMouthOuter, head.geometry);
  FeaturePatch first = snake.patch(cut(clip[0]), head.pose);

  Mouth() { snake.learn(first); }

  [[nodiscard]] WorkFrame cut(const Picture& picture) const {
    return WorkFrame::cut(picture, head.pose.shift, head.pose.eye_distance_px(), true);
  }
};

double most(const cv::Mat1f& m) {
  double low = 0, high = 0;
  cv::minMaxLoc(m, &low, &high);
  return std::max(-low, high);
}

double most_apart(const cv::Mat1f& a, const cv::Mat1f& b) {
  return most(cv::Mat1f(a - b));
}

TEST(FeatureSnake, SeesNoChangeInTheFirstPictureNorInAPictureThatRepeats) {
  Mouth m, still;
  still.snake.weights.change = 0;
  const SnakeImage plain = still.snake.observe(m.first);
  for (int i = 0; i < 2; ++i) {
    const SnakeImage seen = m.snake.observe(m.first);
    EXPECT_LT(most_apart(seen.contrast_x, plain.contrast_x), 1e-5) << i;
    EXPECT_LT(most_apart(seen.contrast_y, plain.contrast_y), 1e-5) << i;
  }
}

// Eq. 8: the contrast of I_t is added with its sign, so that an edge that has come counts more, and one that
// has gone repels.
TEST(FeatureSnake, ChangeAddsTheContrastOfWhatHasChanged) {
  Mouth m, still;
  still.snake.weights.change = 0;
  FeaturePatch darker = m.first;
  darker[0] = m.first[0].clone();
  darker[0](cv::Rect(4, 4, 20, 12)) -= cv::Scalar(40);
  const cv::Mat1f before = still.snake.observe(m.first).contrast_y,
                  now = still.snake.observe(darker).contrast_y;
  ASSERT_GT(most_apart(now, before), 0.02);
  const double gamma = m.snake.weights.change;
  ASSERT_GT(gamma, 0);
  (void)m.snake.observe(m.first);
  EXPECT_LT(most_apart(m.snake.observe(darker).contrast_y, now + gamma * (now - before)), 1e-4) << "there";
  EXPECT_LT(most_apart(m.snake.observe(m.first).contrast_y, before + gamma * (before - now)), 1e-4) << "back";
}

TEST(FeatureSnake, ImageIsThePatchInSnakeUnits) {
  Mouth m;
  const SnakeImage image = m.snake.observe(m.first);
  EXPECT_EQ(image.origin, glm::dvec2(m.snake.plane.region.x, m.snake.plane.region.y));
  EXPECT_NEAR(image.contrast_x.cols / image.px_per_unit, m.snake.plane.region.width, 1);
  EXPECT_NEAR(image.contrast_y.rows / image.px_per_unit, m.snake.plane.region.height, 1);
  EXPECT_TRUE(image.ridge.empty()) << "lips are a border and not a band";
}

// The patch is cut out in the head's own frame: a head that has moved, turned and grown shows the same patch.
TEST(FeatureSnake, PatchGoesWithTheHead) {
  Mouth m;
  const Picture& first = m.clip[0];
  const double a = 0.2, scale = 1.15;
  Pose pose = m.head.pose;
  pose.roll += a;
  pose.log2_scale += std::log2(scale);
  pose.shift += glm::dvec2(6, -3);
  // The same picture under that similarity about the head frame's origin.
  const double c = scale * std::cos(a), s = scale * std::sin(a);
  const glm::dvec2 o = m.head.pose.shift - 0.5, to = pose.shift - 0.5;
  const cv::Matx23d matrix(c, -s, to.x - c * o.x + s * o.y, s, c, to.y - s * o.x - c * o.y);
  Picture moved_picture = first;
  cv::Mat from(first.height(), first.width(), CV_8U, const_cast<std::uint8_t*>(first.y.samples.data()));
  cv::Mat out(first.height(), first.width(), CV_8U, moved_picture.y.samples.data());
  cv::warpAffine(from, out, matrix, out.size(), cv::INTER_CUBIC);
  const FeaturePatch seen =
      m.snake.patch(WorkFrame::cut(moved_picture, pose.shift, m.head.pose.eye_distance_px(), true), pose);
  cv::Mat difference;
  cv::absdiff(seen[0], m.first[0], difference);
  EXPECT_LT(cv::mean(difference)[0], 2.5);
  cv::absdiff(m.snake.patch(m.cut(moved_picture), m.head.pose)[0], m.first[0], difference);
  EXPECT_GT(cv::mean(difference)[0], 6) << "else the test sees nothing";
}

TEST(FeatureSnake, ALidIsHeldAboveTheLowerLid) {
  Mouth m;
  const FeatureSnake lid = FeatureSnake::make(FeatureId::kUpperLidRight, m.head.geometry);
  std::vector<glm::dvec2> control = lid.rest;
  lid.limit(control);
  EXPECT_EQ(control, lid.rest) << "an open eye is left alone";
  for (int i = lid.curve.first_free(); i < lid.curve.end_free(); ++i) control[i].y += 20;
  lid.limit(control);
  EXPECT_NEAR(curve_point(clamped_basis(true, 0.5), control).y, lid.lowest, 1e-9);
  EXPECT_EQ(control.front(), lid.rest.front()) << "corners are pinned";
}

}  // namespace
}  // namespace fbs
