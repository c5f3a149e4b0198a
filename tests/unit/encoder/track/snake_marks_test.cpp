#include "encoder/track/snake_marks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

double distance(const AdaptedHead& head, const Marks& truth, int landmark) {
  const glm::dvec2 seen =
      PoseProjection(head.pose)(glm::dvec3(head.geometry.positions[vertex_of_landmark(landmark)]));
  return std::hypot(seen.x - truth.landmark(landmark)->x, seen.y - truth.landmark(landmark)->y);
}

/// The outer lips' four points on the midline and at the corners.
constexpr int kLips[] = {48, 51, 54, 57};

TEST(SnakeMarks, BringLipsBackThatWereMarkedALittleOff) {
  TalkerClip clip(talker_settings(352, 288, 1));
  const Marks truth = clip.marks(0);
  const double eye = clip.pose(0).eye_distance_px();
  Marks off = truth;
  for (int k = 48; k < 68; ++k) off.set_landmark(k, *truth.landmark(k) + glm::dvec2(0, 0.08 * eye));
  const auto plain = adapt_head(off), corrected = adapt_with_snakes(clip[0], off);
  ASSERT_TRUE(plain && corrected);
  double before = 0, after = 0;
  for (const int k : kLips) {
    before += distance(*plain, truth, k);
    after += distance(*corrected, truth, k);
  }
  EXPECT_LT(after, 0.85 * before);
}

TEST(SnakeMarks, BrowsKeepTheirs) {
  TalkerClip clip(talker_settings(352, 288, 1));
  const Marks truth = clip.marks(0);
  const auto plain = adapt_head(truth), corrected = adapt_with_snakes(clip[0], truth);
  ASSERT_TRUE(plain && corrected);
  for (int k = 17; k < 27; ++k)
    EXPECT_LT(std::abs(distance(*corrected, truth, k) - distance(*plain, truth, k)),
              0.02 * clip.pose(0).eye_distance_px())
        << k;
}

TEST(SnakeMarks, NeedBothEyes) {
  TalkerClip clip(talker_settings(176, 144, 1));
  Marks blind = clip.marks(0);
  for (int k = 42; k < 48; ++k) blind.vertex[vertex_of_landmark(k)].reset();
  const auto adapted = adapt_with_snakes(clip[0], blind);
  ASSERT_FALSE(adapted);
  EXPECT_EQ(adapted.error().code, ErrorCode::kDegenerateInput);
}

}  // namespace
}  // namespace fbs
