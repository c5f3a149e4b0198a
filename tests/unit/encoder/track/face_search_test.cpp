#include "encoder/track/face_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "encoder/find/adapt.h"
#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

const FaceFinder& finder() {
  static const Result<FaceFinder> f = FaceFinder::create();
  EXPECT_TRUE(f) << f.error().text;
  return *f;
}

/// Luma `by` pixels farther right; its left column fills what comes in.
Picture pushed_aside(const Picture& picture, int by) {
  Picture out(picture.width(), picture.height());
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) out.y.row(y)[x] = picture.y.row(y)[std::max(0, x - by)];
  return out;
}

Picture upside_down(const Picture& picture) {
  Picture out(picture.width(), picture.height());
  for (int y = 0; y < picture.height(); ++y)
    std::copy_n(picture.y.row(y), picture.width(), out.y.row(picture.height() - 1 - y));
  return out;
}

/// A head known from picture 0 of a clip, with true marks, and a search for it.
struct Lost {
  explicit Lost(TalkerClip& clip)
      : head(*adapt_head(clip.marks(0))),
        tracker(head.geometry, head.pose,
                WorkFrame::cut(clip[0], head.pose.shift, head.pose.eye_distance_px(), false)) {
    for (std::size_t v = 0; v < kVertexCount; ++v) neutral[v] = glm::dvec3(head.geometry.positions[v]);
  }

  FaceSearch::Detection find(const Picture& picture) {
    return search.find(picture, tracker, head.pose, neutral);
  }

  AdaptedHead head;
  HeadTracker tracker;
  HeadVertices neutral;
  FaceSearch search{finder()};
};

double distance(glm::dvec2 a, glm::dvec2 b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

talker::Settings turning() {
  auto settings = talker_settings(352, 288, 120);
  settings.yaw_deg = 25;
  return settings;
}

int most_turned(const TalkerClip& clip) {
  int most = 0;
  for (int i = 0; i < clip.count(); ++i)
    if (std::abs(clip.pose(i).yaw) > std::abs(clip.pose(most).yaw)) most = i;
  return most;
}

TEST(FaceSearch, FindsATurnedHeadBesideWhereItWasAtOnce) {
  TalkerClip clip(turning());
  const int turned = most_turned(clip);
  ASSERT_GT(std::abs(clip.pose(turned).yaw), 15 * kDegree);
  Lost lost(clip);
  const double eye = lost.head.pose.eye_distance_px();
  const int aside = static_cast<int>(0.6 * eye);
  const FaceSearch::Detection found = lost.find(pushed_aside(clip[turned], aside));
  EXPECT_TRUE(found.accepted) << found.head.confidence;
  EXPECT_NEAR(found.head.pose.yaw, clip.pose(turned).yaw, 6 * kDegree);
  const glm::dvec2 moved = clip.pose(turned).shift - clip.pose(0).shift + glm::dvec2(aside, 0);
  EXPECT_LT(distance(found.head.pose.shift - lost.head.pose.shift, moved), 0.2 * eye);
}

// Beyond the reach of the search around: the cascade looks there, if not in every picture.
TEST(FaceSearch, FindsAHeadFarAwayWithinAFewPictures) {
  TalkerClip clip(talker_settings(352, 288, 1));
  Lost lost(clip);
  const double eye = lost.head.pose.eye_distance_px();
  const int aside = static_cast<int>(2 * eye);
  const Picture there = pushed_aside(clip[0], aside);
  FaceSearch::Detection found;
  int pictures = 0;
  while (!found.accepted && pictures < 4) {
    found = lost.find(there);
    ++pictures;
  }
  EXPECT_TRUE(found.accepted) << found.head.confidence;
  EXPECT_LT(distance(found.head.pose.shift - lost.head.pose.shift, {aside, 0}), 0.1 * eye);
}

TEST(FaceSearch, FindsNothingWhereNothingIsSeen) {
  TalkerClip clip(talker_settings(352, 288, 1));
  Lost lost(clip);
  const Picture grey(352, 288);
  for (int i = 0; i < 4; ++i) {
    const FaceSearch::Detection found = lost.find(grey);
    EXPECT_FALSE(found.accepted);
    EXPECT_EQ(found.head.confidence, 0);
  }
}

// A wildly wrong face is worse than a held one.
TEST(FaceSearch, DoesNotTakeAnythingElseForTheHead) {
  TalkerClip clip(talker_settings(352, 288, 40));
  Lost lost(clip);
  for (int i = 0; i < 40; i += 8) {
    const FaceSearch::Detection found = lost.find(upside_down(clip[i]));
    EXPECT_FALSE(found.accepted) << "picture " << i << ", " << found.head.confidence;
  }
}

TEST(FaceSearch, DoesNotTakeAnotherSizeForTheHead) {
  auto settings = talker_settings(352, 288, 1);
  TalkerClip clip(settings);
  settings.eye_distance = 0.3F;
  TalkerClip near(settings);
  Lost lost(clip);
  for (int i = 0; i < 4; ++i) EXPECT_FALSE(lost.find(near[0]).accepted);
}

// A head that leaves most of the picture is held, not followed out of sight.
TEST(FaceSearch, DoesNotAcceptAHeadMostlyOutside) {
  TalkerClip clip(talker_settings(352, 288, 1));
  Lost lost(clip);
  const int aside = 352 - static_cast<int>(lost.head.pose.shift.x + 0.2 * lost.head.pose.eye_distance_px());
  for (int i = 0; i < 4; ++i) EXPECT_FALSE(lost.find(pushed_aside(clip[0], aside)).accepted);
}

TEST(FaceSearch, KnowsWhetherItIsSearching) {
  TalkerClip clip(talker_settings(352, 288, 1));
  Lost lost(clip);
  EXPECT_FALSE(lost.search.lost());
  (void)lost.find(Picture(352, 288));
  EXPECT_TRUE(lost.search.lost());
  lost.search.rest();
  EXPECT_FALSE(lost.search.lost());
}

}  // namespace
}  // namespace fbs
