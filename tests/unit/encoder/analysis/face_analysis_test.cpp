#include "encoder/analysis/face_analysis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/ibug.h"
#include "encoder/find/adapt.h"
#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

constexpr int kFrames = 12;

/// An analysis that begins on a talker's first picture with true marks; the pattern is the source itself.
class Session {
 public:
  explicit Session(const EncoderSettings& settings, int frames = kFrames)
      : clip_(talker_settings(176, 144, frames)),
        head_(*adapt_head(clip_.marks(0))),
        finder_(*FaceFinder::create()) {
    setup_.format = clip_.format();
    const auto pose = numbers_of(head_.pose);
    for (std::size_t i = 0; i < kPoseCount; ++i)
      seen_.pose[i] = static_cast<std::int32_t>(std::lround(pose[i]));
    analysis_ =
        std::make_unique<FaceAnalysis>(settings, finder_,
                                       AnalysisStart{setup_, head_.geometry, clip_[0], clip_[0], seen_,
                                                     head_.pose.shift, head_.pose.eye_distance_px()});
  }

  FaceAnalysis::Observation observe(const Picture& picture) { return analysis_->observe(picture); }
  FaceAnalysis::Observation observe(int frame) { return observe(clip_[frame]); }
  /// With the true landmarks, by another tracker.
  FaceAnalysis::Observation observe_with_landmarks(int frame) {
    const Shape shape = clip_.shape(frame);
    LandmarkPoints points;
    std::copy(shape.begin(), shape.end(), points.begin());
    analysis_->give_landmarks(points);
    return observe(frame);
  }
  [[nodiscard]] const PictureAnalysis& report() const { return analysis_->report(); }
  [[nodiscard]] const State& seen() const { return seen_; }
  [[nodiscard]] const Geometry& geometry() const { return head_.geometry; }
  [[nodiscard]] TalkerClip& clip() { return clip_; }

 private:
  TalkerClip clip_;
  AdaptedHead head_;
  FaceFinder finder_;
  Setup setup_;
  State seen_;
  std::unique_ptr<FaceAnalysis> analysis_;
};

TEST(FaceAnalysis, FirstPictureIsInTheStateItWasSeenIn) {
  Session session({});
  const auto first = session.observe(0);
  EXPECT_EQ(first.state, session.seen());
  EXPECT_TRUE(first.face);
  EXPECT_EQ(session.report().confidence, 1);
  EXPECT_TRUE(session.report().face);
}

TEST(FaceAnalysis, CostsAreOfTheHeadsNumbers) {
  Session session({});
  const PictureCost cost = session.observe(0).cost;
  ASSERT_EQ(cost.layers.size(), 1U);
  EXPECT_EQ(cost.layers[0].layer, CostLayer::kHead);
  for (const PartId surround : {PartId::kBody, PartId::kGround})
    for (int i = 0; i < kSimilarityCount; ++i)
      EXPECT_EQ(cost.layers[0].quadratic(first_of(surround) + i, first_of(surround) + i), 0) << i;
}

TEST(FaceAnalysis, FollowsTheTalker) {
  Session session({});
  const Pose first = pose_of(session.observe(0).state), true_first = session.clip().pose(0);
  for (int t = 1; t < kFrames; ++t) {
    const Pose now = pose_of(session.observe(t).state), truth = session.clip().pose(t);
    const glm::dvec2 off = (now.shift - first.shift) - (truth.shift - true_first.shift);
    EXPECT_LT(std::hypot(off.x, off.y), 0.1 * truth.eye_distance_px()) << t;
    EXPECT_GT(session.report().confidence, 0.8) << t;
  }
}

/// Between the inner lips, eye distances.
double opening(const Shape& s) {
  return static_cast<double>(s[ibug::kLowerLipInner].y - s[ibug::kUpperLipInner].y) /
         static_cast<double>(eye_distance(s));
}

// Landmarks are looked for in each picture, so that nothing need lead there.
TEST(FaceAnalysis, AMouthThatOpensAtOnceIsFollowed) {
  Session session({}, 150);
  int widest = 0;
  for (int t = 0; t < 150; ++t)
    if (opening(session.clip().shape(t)) > opening(session.clip().shape(widest))) widest = t;
  const auto seen = [&session](int t) {
    const HeadVertices v = skinned(session.geometry(), fit_of(session.observe(t).state).offsets);
    return static_cast<double>(mouth_gap(v)) / kUnitsPerEyeDistance;
  };
  const double change = seen(0) - seen(widest);
  const double truth = opening(session.clip().shape(0)) - opening(session.clip().shape(widest));
  EXPECT_NEAR(change / truth, 1, 0.35);
}

// The paper's own path: nothing that only a comparison of pictures shows.
TEST(FaceAnalysis, TrackingAloneMovesMouthAndBrowsAndFitsNothing) {
  EncoderSettings settings;
  settings.track_only = true;
  Session session(settings);
  glm::ivec2 lips(0);
  for (int t = 0; t < kFrames; ++t) {
    const State state = session.observe(t).state;
    EXPECT_EQ(state.light, State{}.light);
    EXPECT_EQ(state.interior, State{}.interior);
    for (const FeatureId id : {FeatureId::kPupilRight, FeatureId::kPupilLeft})
      EXPECT_EQ(state.control[feature(id).first_control], glm::ivec2(0));
    for (int c = 0; c < 10; ++c) lips += glm::abs(state.control[static_cast<std::size_t>(c)]);
  }
  EXPECT_GT(lips.x + lips.y, 0);
}

TEST(FaceAnalysis, GivenLandmarksAreAStartOncePicturesHaveShownWhatTheyAreOffBy) {
  Session session({});
  (void)session.observe(0);
  EXPECT_FALSE(session.report().had_landmarks);
  (void)session.observe_with_landmarks(1);
  EXPECT_FALSE(session.report().had_landmarks) << "the first ones";
  int best = 0;
  for (int t = 2; t < kFrames; ++t) {
    (void)session.observe_with_landmarks(t);
    EXPECT_TRUE(session.report().had_landmarks) << t;
    best += session.report().from_landmarks ? 1 : 0;
  }
  EXPECT_GT(best, 0) << "true landmarks are never the best start";
  (void)session.observe(kFrames - 1);
  EXPECT_FALSE(session.report().had_landmarks) << "they are of one picture";
  EXPECT_FALSE(session.report().from_landmarks);
}

TEST(FaceAnalysis, HoldsThePoseAndRelaxesTheExpressionWhileTheFaceIsLost) {
  Session session({});
  State last;
  for (int t = 0; t < 6; ++t) last = session.observe(t).state;
  const Picture black(176, 144);
  const auto offset = [](const State& s) {
    double sum = 0;
    for (const glm::ivec2& c : s.control) sum += std::hypot(c.x, c.y);
    return sum;
  };
  ASSERT_GT(offset(last), 0);
  for (int t = 0; t < 20; ++t) {
    const auto lost = session.observe(black);
    EXPECT_FALSE(lost.face);
    EXPECT_EQ(lost.state.pose, last.pose);
    EXPECT_LE(offset(lost.state), offset(last) + kControlCount) << "rounded to whole units";
    last = lost.state;
  }
  EXPECT_LT(offset(last), 5 * kControlCount);
  EXPECT_LT(session.report().confidence, FaceSearch::kLostBelow);
}

TEST(FaceAnalysis, ReportsSnakesUnlessTheyAreOff) {
  Session with({});
  (void)with.observe(0);
  ASSERT_EQ(with.report().snakes.size(), kSnakeFeatures.size());
  for (std::size_t i = 0; i < kSnakeFeatures.size(); ++i)
    EXPECT_EQ(with.report().snakes[i].closed, feature(kSnakeFeatures[i]).closed);
}

}  // namespace
}  // namespace fbs
