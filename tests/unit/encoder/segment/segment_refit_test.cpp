#include "encoder/segment/segment_refit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/encoder/blend/blended_scene.h"

namespace fbs {
namespace {

constexpr std::size_t kGroup = 7, kPictures = 21;

/// A head that swings between patterns, and a segment whose motion knows nothing of it.
struct StillSegment {
  BlendedScene s{1};
  Segment segment;
  SegmentRefit refit;
  Workers workers{2};

  StillSegment()
      : refit(setup(), toy_geometry(), s.scene.patterns[0], WorkFrame::kWorkEyeDistance,
              MotionTrack(setup(), coded_rest(), RatePlan{OperatingPoint::at(100, 48), 0},
                          SceneTiming(setup().format, {}))) {
    for (const std::int32_t t : {10, 20}) s.add_pattern(rest(t), 1);
    for (std::size_t t = 0; t < kPictures; ++t) {
      EXPECT_TRUE(segment.pictures.add(rendered(s.scene, truth(t))));
      segment.states.push_back(rest(static_cast<std::int32_t>(t)));
      segment.states.back().blend.fill(BlendMode::kByTime);
    }
    for (std::size_t t = 0; t < kPictures; t += kGroup) segment.groups.push_back({kGroup, {}});
  }

  static State rest(std::int32_t picture) {
    State state = SeenScene::rest();
    state.picture = picture;
    return state;
  }
  /// At rest in the patterns' pictures.
  static State truth(std::size_t t) {
    State state = rest(static_cast<std::int32_t>(t));
    state.blend.fill(BlendMode::kByTime);
    state.pose[kShiftX] += std::lround(80 * std::sin(std::numbers::pi / 10 * static_cast<double>(t)));
    return state;
  }
  static Setup setup() {
    Setup out = toy_setup(BlendedScene::kWidth, BlendedScene::kHeight);
    out.steps = OperatingPoint::at(100, WorkFrame::kWorkEyeDistance).steps;
    return out;
  }
  static CodedState coded_rest() {
    CodedState out{};
    for (std::size_t i = 0; i < kPoseCount; ++i)
      out[i] = static_cast<std::int32_t>(
          std::lround(static_cast<double>(rest(0).pose[i]) / step_of(setup().steps, i)));
    return out;
  }
  void analyse(std::size_t t, bool face) {
    FaceAnalysis::Observation seen{segment.states[t], face, {}, {}, {}, WorkFrame::kWorkEyeDistance};
    seen.cost.layers.push_back(
        {CostLayer::kSurround, 0, 0, cv::Mat1d::zeros(kParameterCount, kParameterCount)});
    refit.add(seen);
    if ((t + 1) % kGroup == 0) refit.end_group(std::vector<std::uint32_t>(kGroup));
  }
  void run() {
    const std::vector<AvailablePatterns> all(segment.groups.size(), s.all());
    ASSERT_TRUE(refit.run(segment, {s.blend(), all}, workers));
  }
  [[nodiscard]] double off(std::size_t t, const State& from) const {
    return std::abs(segment.states[t].pose[kShiftX] - from.pose[kShiftX]) / kStateUnitsPerPixel;
  }
};

TEST(SegmentRefit, StatesFollowWhatPatternsDoNotShow) {
  StillSegment d;
  for (std::size_t t = 0; t < kPictures; ++t) d.analyse(t, true);
  d.run();
  double before = 0, after = 0;
  for (std::size_t t = 0; t < kPictures; ++t) {
    after += d.off(t, StillSegment::truth(t));
    before += std::abs(StillSegment::truth(t).pose[kShiftX] - StillSegment::rest(0).pose[kShiftX]) /
              kStateUnitsPerPixel;
    EXPECT_EQ(d.segment.states[t].picture, static_cast<std::int32_t>(t));
    EXPECT_EQ(d.segment.states[t].blend, StillSegment::truth(t).blend);
  }
  EXPECT_LT(after, 0.5 * before);
  for (const Segment::Group& g : d.segment.groups) EXPECT_FALSE(g.payload.empty());
}

TEST(SegmentRefit, PatternsStayWhereTheyWereSeen) {
  StillSegment d;
  for (std::size_t t = 0; t < kPictures; ++t) d.analyse(t, true);
  d.run();
  for (const std::size_t t : {0U, 10U, 20U}) EXPECT_LT(d.off(t, StillSegment::rest(0)), 0.2) << t;
}

// A picture without a face says nothing about the state.
TEST(SegmentRefit, ALostFaceRests) {
  StillSegment d;
  for (std::size_t t = 0; t < kPictures; ++t) d.analyse(t, t < kGroup || t >= 2 * kGroup);
  d.run();
  ASSERT_GT(std::abs(StillSegment::truth(7).pose[kShiftX] - StillSegment::truth(13).pose[kShiftX]), 64);
  for (std::size_t t = kGroup; t < 2 * kGroup; ++t) EXPECT_LT(d.off(t, d.segment.states[kGroup]), 0.1) << t;
  EXPECT_GT(d.off(4, StillSegment::rest(0)), 0.6) << "others follow";
}

TEST(SegmentRefit, CanRunAgainFromTheBeginningOfTheSegment) {
  StillSegment d;
  for (std::size_t t = 0; t < kPictures; ++t) d.analyse(t, true);
  const auto error = [&] {
    double sum = 0;
    for (std::size_t t = 0; t < kPictures; ++t)
      sum += squares(rendered(d.s.scene, d.segment.states[t]), *d.segment.pictures.read(t));
    return sum;
  };
  const double before = error();
  ASSERT_FALSE(d.refit.motion());
  d.run();
  const double once = error();
  d.run();
  EXPECT_LT(once, 0.5 * before);
  EXPECT_LT(error(), 1.05 * once);
  EXPECT_TRUE(d.refit.motion());
}

}  // namespace
}  // namespace fbs
