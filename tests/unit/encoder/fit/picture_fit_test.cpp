#include "encoder/fit/picture_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/encoder/fit/fitted_scene.h"

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
      state.control[feature(id).first_control + i] = {0, -350};
  return state;
}

/// With the lower lip hanging.
State with_open_mouth(State state) {
  const Feature& inner = feature(FeatureId::kMouthInner);
  for (const int c : {4, 5, 6, 7}) state.control[inner.first_control + c].y = 1000;
  return state;
}

TEST(PictureFit, RefineFindsPoseAndExpression) {
  FittedScene s;
  const State truth = other_state(s);
  s.set_picture(truth);
  const Fit found = s.fit.refine({pose_of(s.seen), {}, {}});
  const Pose expected = pose_of(truth);
  EXPECT_NEAR(found.pose.yaw, expected.yaw, kDegreeRad);
  EXPECT_NEAR(found.pose.pitch, expected.pitch, kDegreeRad);
  EXPECT_NEAR(found.pose.roll, expected.roll, 0.5 * kDegreeRad);
  EXPECT_NEAR(found.pose.shift.x, expected.shift.x, 1);
  EXPECT_NEAR(found.pose.shift.y, expected.shift.y, 1);
  const Picture source = s.drawn(truth);
  EXPECT_LT(squares(s.drawn(state_of(found)), source), 0.35 * squares(s.drawn(s.seen), source));
  double brow = 0;
  for (int i = 0; i < 4; ++i) brow += found.offsets[feature(FeatureId::kBrowRight).first_control + i].y / 4;
  EXPECT_LT(brow, -100) << "raised";
}

TEST(PictureFit, RefineStaysWhereThePictureIsThePattern) {
  FittedScene s;
  s.set_picture(s.seen);
  const Pose start = pose_of(s.seen);
  const Fit found = s.fit.refine({start, {}, {}});
  EXPECT_NEAR(found.pose.yaw, start.yaw, 0.3 * kDegreeRad);
  EXPECT_NEAR(found.pose.shift.x, start.shift.x, 0.1);
  EXPECT_NEAR(found.pose.shift.y, start.shift.y, 0.1);
  for (const glm::dvec2 o : found.offsets) EXPECT_LT(std::hypot(o.x, o.y), 0.02 * kUnitsPerEyeDistance);
}

TEST(PictureFit, InnerLipsThatWereLeftBehindAreFoundAgain) {
  FittedScene s;
  State truth = s.seen;
  for (const std::size_t lower : {6U, 7U, 8U, 9U}) truth.control[lower].y = 600;
  s.set_picture(truth);
  Fit start{pose_of(s.seen), {}, {}, {}};
  for (std::size_t c = 0; c < kControlCount; ++c) start.offsets[c] = glm::dvec2(truth.control[c]);
  const Feature& inner = feature(FeatureId::kMouthInner);
  Fit strayed = start;
  for (const int c : {5, 6, 7})  // of the lower lip
    strayed.offsets[inner.first_control + c].y = -400;
  const auto gap = [&](const Fit& fit) {
    return std::abs(mouth_gap(deform(toy_geometry().positions, state_of(fit))) -
                    mouth_gap(deform(toy_geometry().positions, truth)));
  };
  ASSERT_GT(gap(strayed), 100);
  EXPECT_LT(gap(s.fit.refine_mouth(strayed)), gap(s.fit.refine(strayed)) / 2);
  EXPECT_EQ(s.fit.refine_mouth(start).offsets, s.fit.refine(start).offsets) << "which have not strayed";
}

TEST(PictureFit, PartsThatAreNotSentDoNotMove) {
  FittedScene s;
  fbs::Setup few = s.setup;
  few.parts = static_cast<PartMask>(mask_of(PartId::kPose) | mask_of(PartId::kBrows));
  PictureFit fit(few, toy_geometry(),
                 {WorkFrame::cut(s.scene.patterns[0].picture, {160, 96}, 48, true), s.seen});
  fit.set_picture(WorkFrame::cut(s.drawn(other_state(s)), {160, 96}, 48, true), few.mouth);
  const Fit found = fit.refine({pose_of(s.seen), {}, {}});
  const ExpressionPart& brows = generic_head().expression[1];
  for (int i = 0; i < kControlCount; ++i) {
    const bool sent = i >= brows.first_control && i < brows.first_control + brows.control_count;
    EXPECT_EQ(found.offsets[i] != glm::dvec2(0), sent) << i;
  }
}

TEST(PictureFit, LightIsFound) {
  FittedScene s;
  for (const std::array<int, kLightCount>& light :
       {std::array{15, 0, 0, 0, 0, 0, 0}, {-12, 8}, {5, -6, 10}, {0, 0, -8, 12}, {0, 0, 0, 0, 10, -8, 6}}) {
    State truth = s.seen;
    for (std::size_t i = 0; i < kLightCount; ++i) truth.light[i] = 16 * light[i];
    s.set_picture(truth);
    const Fit found = s.fit.refine({pose_of(s.seen), {}, {}});
    for (std::size_t i = 0; i < kLightCount; ++i) EXPECT_NEAR(found.light[i], light[i], 1.5) << i;
    EXPECT_NEAR(found.pose.shift.x, pose_of(s.seen).shift.x, 0.2) << "light is not taken for motion";
  }
}

TEST(PictureFit, StateOfAFitIsItInWholeUnits) {
  FittedScene s;
  State state = other_state(s);
  state.light = {-100, 7, 80, 16};
  state.interior = {33, -50, 4};
  EXPECT_EQ(state_of(fit_of(state)), state);
  Fit fit = fit_of(state);
  fit.light[0] += 0.4 / 16;
  fit.offsets[3] += 0.4;
  EXPECT_EQ(state_of(fit), state);
}

TEST(PictureFit, MouthsInsideIsFound) {
  FittedScene s;
  for (const std::array<int, kInteriorCount>& inside : {std::array{40, 0, 0}, {0, 40, 0}, {-30, -30, 40}}) {
    State truth = with_open_mouth(s.seen);
    const Fit start = fit_of(truth);
    for (std::size_t i = 0; i < kInteriorCount; ++i) truth.interior[i] = 16 * inside[i];
    s.set_picture(truth);
    const Fit found = s.fit.refine(start);
    for (std::size_t i = 0; i < kInteriorCount; ++i) EXPECT_NEAR(found.interior[i], inside[i], 15) << i;
  }
}

// The least eigenvalue of a sum of squares is not below zero, but for rounding.
TEST(PictureFit, FormIsSymmetricAndPositiveSemidefinite) {
  FittedScene s;
  State truth = with_open_mouth(other_state(s));
  truth.light = {160, 0, 80, 0};
  s.set_picture(truth);
  const PictureCost cost = s.fit.cost_at(fit_of(truth));
  ASSERT_EQ(cost.quadratic().rows, kParameterCount);
  EXPECT_LT(cv::norm(cost.quadratic() - cost.quadratic().t()), 1e-9 * cv::norm(cost.quadratic()));
  cv::Mat1d values;
  ASSERT_TRUE(cv::eigen(cost.quadratic(), values));
  EXPECT_GT(values(kParameterCount - 1), -1e-9 * values(0));
  for (int i = 0; i < kParameterCount; ++i) {
    const bool surround =
        kPartOf[i] == static_cast<int>(PartId::kBody) || kPartOf[i] == static_cast<int>(PartId::kGround);
    EXPECT_EQ(cost.quadratic()(i, i) > 0, !surround) << i;
  }
}

TEST(PictureFit, FormSaysNothingOfTheInsideOfAShutMouth) {
  FittedScene s;
  s.set_picture(s.seen);
  const PictureCost cost = s.fit.cost_at(fit_of(s.seen));
  for (int i = 0; i < kParameterCount; ++i)
    if (kPartOf[i] == static_cast<int>(PartId::kMouthInterior)) {
      EXPECT_EQ(cv::countNonZero(cost.quadratic().row(i)), 0) << i;
    }
}

TEST(PictureFit, FormHasTheNumbersOfTheFit) {
  FittedScene s;
  State state = other_state(s);
  state.light = {160, -32, 80, 16};
  state.interior = {48, -16, 7};
  s.set_picture(state);
  for (const PictureCost& cost : {s.fit.cost_at(fit_of(state)), cost_unseen(fit_of(state))}) {
    CodedState values;
    for (std::size_t i = 0; i < kParameterCount; ++i)
      values[i] = static_cast<std::int32_t>(std::lround(cost.fit[i]));
    const State back = state_of_values(values);
    EXPECT_EQ(back.pose, state.pose);
    EXPECT_EQ(back.light, state.light);
    EXPECT_EQ(back.interior, state.interior);
    for (std::size_t c = 0; c < kControlCount; ++c) {
      EXPECT_NEAR(back.control[c].x, state.control[c].x, 4) << c;
      EXPECT_NEAR(back.control[c].y, state.control[c].y, 4) << c;
    }
  }
}

TEST(PictureFit, CostUnseenHoldsThePoseAlone) {
  FittedScene s;
  const cv::Mat1d cost = cost_unseen(fit_of(s.seen)).quadratic();
  for (int i = 0; i < kParameterCount; ++i)
    for (int j = 0; j < kParameterCount; ++j)
      EXPECT_EQ(cost(i, j) > 0, i == j && i < kPoseCount) << i << ' ' << j;
}

// What the encoder weighs bits against is what the decoder's picture shows: it looks at some thousand points
// where the decoder has all samples.
TEST(PictureFit, FormPredictsTheChangeOfTheSquaredDifference) {
  FittedScene s;
  s.set_picture(s.seen);
  const Picture source = s.drawn(s.seen);
  const PictureCost cost = s.fit.cost_at(fit_of(s.seen));
  const auto compare = [&](std::size_t first, std::int32_t by, std::size_t second = 0,
                           std::int32_t and_by = 0) {
    CodedState values;
    for (std::size_t i = 0; i < kParameterCount; ++i)
      values[i] = static_cast<std::int32_t>(std::lround(cost.fit[i]));
    values[first] += by;
    values[second] += and_by;
    cv::Mat1d e = cv::Mat1d::zeros(kParameterCount, 1);
    for (std::size_t i = 0; i < kParameterCount; ++i) e(static_cast<int>(i)) = values[i] - cost.fit[i];
    const double predicted = cv::Mat1d(e.t() * cost.quadratic() * e)(0);
    const double shown = squares(s.drawn(state_of_values(values)), source);
    EXPECT_NEAR(shown / predicted, 1, 0.5) << first << ' ' << second;
  };
  constexpr std::size_t kLight = kPoseCount;
  for (const int side : {-1, 1}) {
    compare(kShiftX, side * 40);
    compare(kShiftY, side * 40);
    compare(kYaw, side * kDegree);
    compare(kRoll, side * kDegree);
    compare(kLogScale, side * 80);
    compare(kLight + kLightOffset, side * 80);
    compare(kLight + kLightGain, side * 80);
    compare(kLight + kLightSlopeX, side * 80);
    compare(kLight + kLightSlopeY, side * 80);
    compare(kFirstCoefficient, side * 150);
    compare(kFirstCoefficient + 36, side * 150);  // brows
    compare(kYaw, kDegree, kShiftX, side * 40);
    compare(kLight + kLightOffset, 80, kLight + kLightSlopeX, side * 80);
  }
}

// A face that has left: nothing to fit, nothing that may go wild.
TEST(PictureFit, FlatPictureMovesNothingFar) {
  FittedScene s;
  s.fit.set_picture(WorkFrame::cut(Picture(320, 240), {160, 96}, 48, true), s.setup.mouth);
  const Pose start = pose_of(s.seen);
  const Fit found = s.fit.refine({start, {}, {}});
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
        state.control[feature(id).first_control + i] = {0, static_cast<int>(std::lround(by))};
    return state;
  };
  const double down = 0.12 * kUnitsPerEyeDistance;
  for (const double truth : {0.0, down}) {
    s.set_picture(lowered(truth));
    Fit start{pose_of(s.seen), {}, {}};
    for (const FeatureId id : lids)
      for (std::size_t i = 0; i < 2; ++i) start.offsets[feature(id).first_control + i] = {0, down - truth};
    const Fit found = s.fit.with_best_lids(start);
    for (const FeatureId id : lids)
      EXPECT_NEAR(found.offsets[feature(id).first_control].y, truth, 0.35 * down);
  }
}

}  // namespace
}  // namespace fbs
