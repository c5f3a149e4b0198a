#include "encoder/track/head/head_appearance.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "encoder/find/landmarks.h"
#include "encoder/model/skinning.h"
#include "encoder/track/head/head_tuning.h"
#include "tests/unit/encoder/track/head/head_case.h"

namespace fbs {
namespace {

TEST(HeadAppearance, IsItselfInTheFirstPicture) {
  HeadCase c;
  const LevelledFrame first(c.frame(0));
  EXPECT_GT(c.appearance.correlation(first, c.head.pose, c.points), 0.999);
}

TEST(HeadAppearance, CorrelationFallsAwayFromThePose) {
  HeadCase c;
  const LevelledFrame first(c.frame(0));
  double before = 1;
  for (const double aside : {0.02, 0.05, 0.1}) {
    Pose pose = c.head.pose;
    pose.shift.x += aside * pose.eye_distance_px();
    const double now = c.appearance.correlation(first, pose, c.points);
    EXPECT_LT(now, before) << aside;
    before = now;
  }
  EXPECT_LT(before, 0.8);
}

TEST(HeadAppearance, NothingIsSeenOutsideThePicture) {
  HeadCase c;
  Pose pose = c.head.pose;
  pose.shift.x += 1000;
  EXPECT_EQ(c.appearance.correlation(LevelledFrame(c.frame(0)), pose, c.points), 0);
}

TEST(HeadAppearance, WhatMovesByItselfWeighsLess) {
  HeadCase c;
  const auto points = c.appearance.points();
  const auto weights = c.appearance.weights();
  ASSERT_EQ(points.size(), weights.size());
  int lips = 0, others = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const bool on_lip = std::any_of(points[k].corner.begin(), points[k].corner.end(), [](std::uint16_t v) {
      return generic_head().vertices[v].landmark >= ibug::kMouthFirst;
    });
    lips += on_lip ? 1 : 0;
    others += weights[k] == 1 ? 1 : 0;
    if (on_lip) {
      EXPECT_LT(weights[k], 1);
    }
  }
  EXPECT_GT(lips, 20);
  EXPECT_GT(others, 100);
}

/// The head's colours in the first picture of a talker, by the first one's appearance.
double colour_difference(const talker::Settings& settings, double light = 1) {
  TalkerClip known(talker_settings(352, 288, 1)), shown(settings);
  const auto head = adapt_head(known.marks(0)), there = adapt_head(shown.marks(0));
  const auto frame = [](const Picture& picture, const Pose& pose) {
    return WorkFrame::cut(picture, pose.shift, pose.eye_distance_px(), true);
  };
  const HeadVertices neutral = skinned(head->geometry, {});
  const HeadAppearance appearance(neutral, head->pose, frame(known[0], head->pose));
  WorkFrame now = frame(shown[0], there->pose);
  now.luma *= light;
  for (cv::Mat* plane : {&now.u, &now.v}) plane->convertTo(*plane, CV_8U, light, 128 * (1 - light));
  return appearance.colour_difference(now, there->pose, appearance.surface(neutral));
}

TEST(HeadAppearance, ColoursAreOfThePerson) {
  auto settings = talker_settings(352, 288, 1);
  EXPECT_EQ(colour_difference(settings), 0);
  EXPECT_LT(colour_difference(settings, 0.5), head_tuning::kStrangersColour / 2) << "in less light";
  settings.eye_distance *= 1.7F;
  EXPECT_LT(colour_difference(settings), head_tuning::kStrangersColour / 2) << "nearer";
  settings.seed = 6;
  EXPECT_GT(colour_difference(settings), head_tuning::kStrangersColour) << "somebody else";
}

}  // namespace
}  // namespace fbs
