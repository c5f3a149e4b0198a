#include "encoder/track/head_tracker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "encoder/find/adapt.h"
#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// The tracker on a clip, begun with true marks: the analysis of FaceAnalysis without its features.
class Track {
 public:
  explicit Track(TalkerClip& clip)
      : clip_(clip),
        head_(*adapt_head(clip.marks(0))),
        eye_(head_.pose.eye_distance_px()),
        tracker_(head_.geometry, head_.pose, cut(0, head_.pose.shift)) {
    for (std::size_t v = 0; v < kVertexCount; ++v) neutral_[v] = glm::dvec3(head_.geometry.positions[v]);
  }

  TrackedPose next(int frame) { return tracker_.track(cut(frame, tracker_.pose().shift), neutral_); }
  TrackedPose next(const Picture& picture) {
    return tracker_.track(WorkFrame::cut(picture, tracker_.pose().shift, eye_, false), neutral_);
  }
  [[nodiscard]] const Pose& first() const { return head_.pose; }
  HeadTracker& tracker() { return tracker_; }

 private:
  WorkFrame cut(int frame, glm::dvec2 centre) { return WorkFrame::cut(clip_[frame], centre, eye_, false); }

  TalkerClip& clip_;
  AdaptedHead head_;
  double eye_;
  HeadTracker tracker_;
  std::array<glm::dvec3, kVertexCount> neutral_;
};

/// How far the pose found is from the true change since the first picture.
struct PoseError {
  double yaw_deg = 0, pitch_deg = 0, roll_deg = 0, shift_eyes = 0, scale_percent = 0;

  void take(const Pose& found, const Pose& first, const Pose& truth, const Pose& true_first) {
    const auto worse = [](double& most, double e) { most = std::max(most, std::abs(e)); };
    worse(yaw_deg, (found.yaw - truth.yaw) / kDegree);
    worse(pitch_deg, (found.pitch - truth.pitch) / kDegree);
    worse(roll_deg, (found.roll - first.roll - truth.roll) / kDegree);
    const glm::dvec2 d = (found.shift - first.shift) - (truth.shift - true_first.shift);
    worse(shift_eyes, std::hypot(d.x, d.y) / truth.eye_distance_px());
    const double scale = (found.log2_scale - first.log2_scale) - (truth.log2_scale - true_first.log2_scale);
    worse(scale_percent, 100 * (std::exp2(scale) - 1));
  }
};

PoseError worst_error(const talker::Settings& settings, int step = 1) {
  TalkerClip clip(settings);
  Track track(clip);
  PoseError worst;
  for (int i = step; i < clip.count(); i += step) {
    const TrackedPose tracked = track.next(i);
    EXPECT_GT(tracked.confidence, 0.8) << "picture " << i;
    worst.take(tracked.pose, track.first(), clip.pose(i), clip.pose(0));
  }
  return worst;
}

// Head frames of talker and generic head differ in depth, which a turn mixes with shift: hence the looser
// bound there.
TEST(HeadTracker, FollowsATalkingHead) {
  const PoseError e = worst_error(talker_settings(352, 288, 40));
  EXPECT_LT(e.yaw_deg, 2.5);
  EXPECT_LT(e.pitch_deg, 2.5);
  EXPECT_LT(e.roll_deg, 1);
  EXPECT_LT(e.shift_eyes, 0.08);
  EXPECT_LT(e.scale_percent, 2);
}

TEST(HeadTracker, FollowsASmallFace) {
  const PoseError e = worst_error(talker_settings(128, 96, 60));
  EXPECT_LT(e.yaw_deg, 5);
  EXPECT_LT(e.pitch_deg, 5);
  EXPECT_LT(e.roll_deg, 2);
  EXPECT_LT(e.shift_eyes, 0.12);
}

TEST(HeadTracker, FollowsThroughNoiseAndChangingLight) {
  auto settings = talker_settings(176, 144, 60);
  settings.noise = 4;
  settings.light = 0.15F;
  const PoseError e = worst_error(settings);
  EXPECT_LT(e.yaw_deg, 4);
  EXPECT_LT(e.pitch_deg, 4);
  EXPECT_LT(e.roll_deg, 1.5);
}

TEST(HeadTracker, HoldsStillWhenTheHeadDoes) {
  auto settings = talker_settings(176, 144, 40);
  settings.still = true;  // but lips, lids and brows move
  const PoseError e = worst_error(settings);
  EXPECT_LT(e.yaw_deg, 1.5);
  EXPECT_LT(e.pitch_deg, 1.5);
  EXPECT_LT(e.roll_deg, 0.5);
  EXPECT_LT(e.shift_eyes, 0.02);
}

// Aligned with picture 0, not with the picture before: going to and fro ends where it began.
TEST(HeadTracker, EndsWhereItBegan) {
  auto settings = talker_settings(176, 144, 90);
  settings.motion = talker::Motion::kLong;
  TalkerClip clip(settings);
  Track track(clip);
  TrackedPose last;
  for (int i = 1; i < clip.count(); ++i) last = track.next(i);
  EXPECT_NEAR(last.pose.yaw, track.first().yaw, 0.2 * kDegree);
  EXPECT_NEAR(last.pose.pitch, track.first().pitch, 0.2 * kDegree);
  EXPECT_NEAR(last.pose.shift.x, track.first().shift.x, 0.1);
  EXPECT_NEAR(last.pose.shift.y, track.first().shift.y, 0.1);
  EXPECT_GT(last.confidence, 0.98);
}

TEST(HeadTracker, DoubtsAPictureWithoutTheHead) {
  TalkerClip clip(talker_settings(176, 144, 2));
  Track track(clip);
  Picture grey(176, 144);
  EXPECT_LT(track.next(grey).confidence, 0.3);
}

TEST(HeadTracker, IsFoundAgainFromARestart) {
  TalkerClip clip(talker_settings(176, 144, 40));
  Track track(clip);
  for (int i = 1; i < 20; ++i) (void)track.next(i);
  const Pose good = track.tracker().pose();
  const Picture grey(176, 144);
  (void)track.next(grey);
  track.tracker().restart(good, WorkFrame::cut(grey, good.shift, track.first().eye_distance_px(), false));
  EXPECT_GT(track.next(20).confidence, 0.8);
}

}  // namespace
}  // namespace fbs
