#include "encoder/track/feature_tracker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "encoder/find/adapt.h"
#include "encoder/track/head_tracker.h"
#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto n = static_cast<double>(a.size());
  double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sa += a[i];
    sb += b[i];
    saa += a[i] * a[i];
    sbb += b[i] * b[i];
    sab += a[i] * b[i];
  }
  return (sab - sa * sb / n) / std::sqrt((saa - sa * sa / n) * (sbb - sb * sb / n));
}

/// The head tracker's and feature tracker's results on a clip, begun with true marks.
struct Followed {
  std::vector<std::array<glm::dvec2, kControlCount>> offsets;  ///< of each picture from 1 on, head units
  std::vector<talker::Expression> truth;
  int most_iterations = 0;

  explicit Followed(TalkerClip clip) {
    const AdaptedHead head = *adapt_head(clip.marks(0));
    const double eye = head.pose.eye_distance_px();
    const WorkFrame first = WorkFrame::cut(clip[0], head.pose.shift, eye, true);
    HeadTracker tracker(head.geometry, head.pose, first);
    FeatureTracker features(head.geometry, head.pose, first);
    std::array<glm::dvec3, kVertexCount> neutral;
    for (std::size_t v = 0; v < kVertexCount; ++v) neutral[v] = glm::dvec3(head.geometry.positions[v]);
    for (int i = 1; i < clip.count(); ++i) {
      const WorkFrame now = WorkFrame::cut(clip[i], tracker.pose().shift, eye, true);
      const TrackedPose pose = tracker.track(now, neutral);
      features.track(now, pose.pose, tracker.flow());
      offsets.push_back(features.offsets());
      truth.push_back(clip.talker().truth(i).expression);
      for (std::size_t s = 0; s < features.count(); ++s)
        most_iterations = std::max(most_iterations, features.iterations(s));
    }
  }

  /// Mean y of some of a feature's control points in each picture, eye distances.
  [[nodiscard]] std::vector<double> heights(FeatureId id, int from, int to) const {
    std::vector<double> out;
    for (const auto& o : offsets) {
      double sum = 0;
      for (int i = from; i < to; ++i) sum += o[feature(id).first_control + i].y;
      out.push_back(sum / (to - from) / kUnitsPerEyeDistance);
    }
    return out;
  }
  template <class Value>
  [[nodiscard]] std::vector<double> true_values(Value value) const {
    std::vector<double> out;
    for (const auto& e : truth) out.push_back(static_cast<double>(value(e)));
    return out;
  }
};

/// A face that fills a small picture: 29 pixels between the eyes.
talker::Settings close_up(talker::Motion motion, int frames) {
  auto settings = talker_settings(176, 144, frames);
  settings.eye_distance = 0.2F;
  settings.motion = motion;
  return settings;
}

const Followed& talking() {
  static const Followed f(TalkerClip(close_up(talker::Motion::kTalk, 75)));
  return f;
}

// Control points of the closed lips run from the right corner over the upper lip: the lower ones are the last
// half.
TEST(FeatureTracker, LowerLipFollowsTheOpeningMouth) {
  const auto lower = talking().heights(FeatureId::kMouthOuter, 7, 9);
  const auto open = talking().true_values([](const auto& e) { return e.mouth_open; });
  EXPECT_GT(*std::max_element(open.begin(), open.end()), 0.1F) << "the talker must talk";
  EXPECT_GT(correlation(lower, open), 0.85);
}

TEST(FeatureTracker, UsesNoMoreIterationsThanThreeDescents) {
  EXPECT_GT(talking().most_iterations, 0);
  EXPECT_LE(talking().most_iterations, 45);
}

TEST(FeatureTracker, BrowsFollowWhenTheyAreRaised) {
  const Followed f{TalkerClip(close_up(talker::Motion::kBrows, 75))};
  const auto right = f.heights(FeatureId::kBrowRight, 0, 4), left = f.heights(FeatureId::kBrowLeft, 0, 4);
  EXPECT_LT(correlation(right, f.true_values([](const auto& e) { return e.brow_right; })), -0.85)
      << "up is less";
  EXPECT_LT(correlation(left, f.true_values([](const auto& e) { return e.brow_left; })), -0.85);
}

/// The farthest that any control point of a feature moves from rest, eye distances.
double farthest(const Followed& f, FeatureId id) {
  double most = 0;
  for (const auto& offsets : f.offsets) {
    for (int i = 0; i < feature(id).control_count; ++i) {
      const glm::dvec2 o = offsets[feature(id).first_control + i];
      most = std::max(most, std::hypot(o.x, o.y) / kUnitsPerEyeDistance);
    }
  }
  return most;
}

const Followed& resting() {
  static const Followed f = [] {
    auto settings = close_up(talker::Motion::kTurns, 30);  // the face is neutral
    settings.still = true;
    settings.noise = 2;
    return Followed(TalkerClip(settings));
  }();
  return f;
}

TEST(FeatureTracker, OuterLipsAndBrowsStayAtRestWhenNothingMoves) {
  for (const FeatureId id : {FeatureId::kMouthOuter, FeatureId::kBrowRight, FeatureId::kBrowLeft})
    EXPECT_LT(farthest(resting(), id), 0.1) << feature(id).name;
}

// Closed lips show no inner contour and open eyes no edge below the lid: what holds them is their own
// regularity, to within a hundredth of the eye distance.
TEST(FeatureTracker, InnerLipsAndLidsStayAtRestWhenNothingMoves) {
  for (const FeatureId id : {FeatureId::kMouthInner, FeatureId::kUpperLidRight, FeatureId::kUpperLidLeft})
    EXPECT_LT(farthest(resting(), id), 0.3) << feature(id).name;
}

TEST(FeatureTracker, GivesBackTheOffsetsItWasSetTo) {
  TalkerClip clip(talker_settings(176, 144, 1));
  const AdaptedHead head = *adapt_head(clip.marks(0));
  const WorkFrame first = WorkFrame::cut(clip[0], head.pose.shift, head.pose.eye_distance_px(), true);
  FeatureTracker features(head.geometry, head.pose, first);
  for (const glm::dvec2 o : features.offsets())
    EXPECT_EQ(o, glm::dvec2(0)) << "at rest after the first picture";
  std::array<glm::dvec2, kControlCount> wanted{};
  const Feature& brow = feature(FeatureId::kBrowRight);
  for (int i = 0; i < brow.control_count; ++i) wanted[brow.first_control + i] = {30, -200};
  features.set_offsets(wanted);
  const auto got = features.offsets();
  for (std::size_t i = 0; i < kControlCount; ++i) {
    EXPECT_NEAR(got[i].x, wanted[i].x, 1e-6) << i;
    EXPECT_NEAR(got[i].y, wanted[i].y, 1e-6) << i;
  }
}

}  // namespace
}  // namespace fbs
