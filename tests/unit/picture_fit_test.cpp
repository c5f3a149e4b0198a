#include "encoder/picture_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/fitted_scene.h"

namespace fbs {
namespace {

constexpr std::int32_t kDegree = 65536 / 360;
constexpr double kDegreeRad = std::numbers::pi / 180;

/// Turned, shifted, brows raised.
State other_state(const FittedScene& s) {
  State state = s.seen;
  state.pose[kYaw] += 3 * kDegree;
  state.pose[kRoll] += 2 * kDegree;
  state.pose[kShiftX] += 2 * 64;
  state.pose[kShiftY] -= 64;
  for (const FeatureId id : {FeatureId::kBrowRight, FeatureId::kBrowLeft})
    for (int i = 0; i < feature(id).control_count; ++i)
      state.control[static_cast<std::size_t>(feature(id).first_control + i)] = {0, -350};
  return state;
}

TEST(PictureFit, TrueStateHasTheLeastDistortion) {
  FittedScene s;
  const State truth = other_state(s);
  s.look_at(truth);
  const double least = s.fit.distortion(truth);
  EXPECT_LT(least, 0.1 * s.fit.distortion(s.seen));
  for (const auto& [index, step] : {std::pair{kPitch, 4 * kDegree},
                                    {kYaw, 4 * kDegree},
                                    {kRoll, 2 * kDegree},
                                    {kShiftX, 96},
                                    {kShiftY, 96},
                                    {kLogScale, 200}}) {
    for (const int side : {-1, 1}) {
      State wrong = truth;
      wrong.pose[index] += side * step;
      EXPECT_GT(s.fit.distortion(wrong), 1.5 * least) << static_cast<int>(index);
    }
  }
}

// It looks at some thousand points where the decoder has all samples.
TEST(PictureFit, DistortionIsNearThatOfTheDecodersPicture) {
  FittedScene s;
  const State truth = other_state(s);
  s.look_at(truth);
  const Picture source = s.drawn(truth);
  for (const int step : {0, 64, 200}) {
    State tried = s.seen;
    tried.pose[kShiftX] += step;
    const Picture shown = s.drawn(tried);
    double squares = 0;
    for (std::size_t i = 0; i < source.y.samples.size(); ++i) {
      const double d = source.y.samples[i] - shown.y.samples[i];
      squares += d * d;
    }
    EXPECT_NEAR(s.fit.distortion(tried) / squares, 1, 0.5) << step;
  }
}

TEST(PictureFit, RefineFindsPoseAndExpression) {
  FittedScene s;
  const State truth = other_state(s);
  s.look_at(truth);
  const Fit found = s.fit.refine({dequantise(s.seen, s.setup.steps), {}});
  const Pose expected = dequantise(truth, s.setup.steps);
  EXPECT_NEAR(found.pose.yaw, expected.yaw, kDegreeRad);
  EXPECT_NEAR(found.pose.pitch, expected.pitch, kDegreeRad);
  EXPECT_NEAR(found.pose.roll, expected.roll, 0.5 * kDegreeRad);
  EXPECT_NEAR(found.pose.shift.x, expected.shift.x, 1);
  EXPECT_NEAR(found.pose.shift.y, expected.shift.y, 1);
  State state;
  state.pose = quantise(found.pose, s.setup.steps);
  for (std::size_t i = 0; i < kControlCount; ++i)
    state.control[i] = {static_cast<int>(std::lround(found.offsets[i].x)),
                        static_cast<int>(std::lround(found.offsets[i].y))};
  EXPECT_LT(s.fit.distortion(state), 0.35 * s.fit.distortion(s.seen));
  double brow = 0;
  for (int i = 0; i < 4; ++i)
    brow += found.offsets[static_cast<std::size_t>(feature(FeatureId::kBrowRight).first_control + i)].y / 4;
  EXPECT_LT(brow, -100) << "raised";
}

TEST(PictureFit, RefineStaysWhereThePictureIsThePattern) {
  FittedScene s;
  s.look_at(s.seen);
  const Pose start = dequantise(s.seen, s.setup.steps);
  const Fit found = s.fit.refine({start, {}});
  EXPECT_NEAR(found.pose.yaw, start.yaw, 0.3 * kDegreeRad);
  EXPECT_NEAR(found.pose.shift.x, start.shift.x, 0.1);
  EXPECT_NEAR(found.pose.shift.y, start.shift.y, 0.1);
  for (const glm::dvec2 o : found.offsets) EXPECT_LT(std::hypot(o.x, o.y), 0.02 * kUnitsPerEyeDistance);
}

TEST(PictureFit, FeaturesThatAreNotSentDoNotMove) {
  FittedScene s;
  fbs::Setup few = s.setup;
  few.features = 1U << static_cast<unsigned>(FeatureId::kBrowRight);
  PictureFit fit(few, toy_geometry(), WorkFrame::cut(s.scene.patterns[0].picture, {160, 96}, 48, true),
                 s.seen);
  fit.look_at(WorkFrame::cut(s.drawn(other_state(s)), {160, 96}, 48, true), few.mouth);
  const Fit found = fit.refine({dequantise(s.seen, few.steps), {}});
  const Feature& brow = feature(FeatureId::kBrowRight);
  for (int i = 0; i < kControlCount; ++i) {
    const bool sent = i >= brow.first_control && i < brow.first_control + brow.control_count;
    EXPECT_EQ(found.offsets[static_cast<std::size_t>(i)] != glm::dvec2(0), sent) << i;
  }
}

// A face that has left: nothing to fit, nothing that may go wild.
TEST(PictureFit, FlatPictureMovesNothingFar) {
  FittedScene s;
  s.fit.look_at(WorkFrame::cut(Picture(320, 240), {160, 96}, 48, true), s.setup.mouth);
  const Pose start = dequantise(s.seen, s.setup.steps);
  const Fit found = s.fit.refine({start, {}});
  EXPECT_TRUE(std::isfinite(found.pose.yaw) && std::isfinite(found.pose.shift.x));
  for (const glm::dvec2 o : found.offsets) EXPECT_TRUE(std::isfinite(o.x) && std::isfinite(o.y));
}

// A blink is over in three pictures: both lids are found shut, or open again, in one step.
TEST(PictureFit, LidsAreFoundWhereverTheyWere) {
  FittedScene s;
  const auto lids = {FeatureId::kUpperLidRight, FeatureId::kUpperLidLeft};
  const auto lowered = [&](double by) {
    State state = s.seen;
    for (const FeatureId id : lids)
      for (int i = 0; i < 2; ++i)
        state.control[static_cast<std::size_t>(feature(id).first_control + i)] = {
            0, static_cast<int>(std::lround(by / s.setup.steps.control))};
    return state;
  };
  const double down = 0.12 * kUnitsPerEyeDistance;
  for (const double truth : {0.0, down}) {
    s.look_at(lowered(truth));
    Fit start{dequantise(s.seen, s.setup.steps), {}};
    for (const FeatureId id : lids)
      for (std::size_t i = 0; i < 2; ++i)
        start.offsets[static_cast<std::size_t>(feature(id).first_control) + i] = {0, down - truth};
    const Fit found = s.fit.with_best_lids(start);
    for (const FeatureId id : lids)
      EXPECT_NEAR(found.offsets[static_cast<std::size_t>(feature(id).first_control)].y, truth, 0.35 * down);
  }
}

}  // namespace
}  // namespace fbs
