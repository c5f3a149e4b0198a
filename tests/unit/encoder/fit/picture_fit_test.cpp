#include "encoder/fit/picture_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "decoder/head/head_deformation.h"
#include "decoder/head/mouth_interior.h"
#include "tests/unit/encoder/fit/fitted_scene.h"
#include "tests/unit/encoder/fit/owner_map.h"

namespace fbs {
namespace {

BestFit refined(const PictureFit& fit, std::span<const FitStart> starts) {
  std::vector<CoarseFit> coarse;
  for (const FitStart& start : starts) coarse.push_back(fit.coarse(start));
  return fit.fine(coarse);
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
    return std::abs(mouth_gap(toy_geometry(), state_of(fit)) - mouth_gap(toy_geometry(), truth));
  };
  ASSERT_GT(gap(strayed), 100);
  const BestFit best = refined(s.fit, PictureFit::starts_of(strayed));
  EXPECT_LT(gap(best.fit), gap(s.fit.refine(strayed)) / 2);
  EXPECT_EQ(best.start, 1);
  EXPECT_EQ(PictureFit::starts_of(start).size(), 1) << "which have not strayed";
}

TEST(PictureFit, TheNearestStartGoesOn) {
  FittedScene s;
  State truth = s.seen;
  truth.pose[kShiftX] += 3 * 64;
  s.set_picture(truth);
  const FitStart far{fit_of(s.seen)}, near{fit_of(truth)};
  for (const bool near_first : {false, true}) {
    const std::array starts = {near_first ? near : far, near_first ? far : near};
    const BestFit best = refined(s.fit, starts);
    EXPECT_EQ(best.start, near_first ? 0 : 1);
    EXPECT_EQ(best.fit.pose.shift, s.fit.refine(near.fit).pose.shift);
  }
  const std::array preferred = {FitStart{.fit = far.fit, .counts = 0.01}, near};
  EXPECT_EQ(refined(s.fit, preferred).start, 0);
}

TEST(PictureFit, LipsAreHeldToTheirStart) {
  FittedScene s;
  s.set_picture(s.seen);
  FitStart start{fit_of(s.seen)};
  const std::size_t lip = feature(FeatureId::kMouthOuter).first_control;
  const double before = start.fit.offsets[lip].y += 0.04 * kUnitsPerEyeDistance;
  const auto moved = [&](double lips) {
    start.lips = lips;
    return std::abs(refined(s.fit, {&start, 1}).fit.offsets[lip].y - before);
  };
  EXPECT_LT(moved(0.1), 0.5 * moved(1));
  EXPECT_GT(moved(1), 0);
}

TEST(PictureFit, AMouthMayOpenWide) {
  FittedScene s;
  State truth = s.seen;
  const Feature& lips = feature(FeatureId::kMouthOuter);
  for (int c = 0; c < lips.control_count; ++c)
    truth.control[lips.first_control + c].y += static_cast<int>(0.5 * kUnitsPerEyeDistance);
  s.set_picture(truth);
  const Fit found = s.fit.refine(fit_of(truth));
  for (int c = 0; c < lips.control_count; ++c)
    EXPECT_GT(found.offsets[lips.first_control + c].y, 0.4 * kUnitsPerEyeDistance);
}

TEST(PictureFit, PupilsMoveTogether) {
  FittedScene s;
  const std::size_t right = feature(FeatureId::kPupilRight).first_control,
                    left = feature(FeatureId::kPupilLeft).first_control;
  const auto found = [&](int of_right, int of_left) {
    State truth = s.seen;
    truth.control[right].x += of_right;
    truth.control[left].x += of_left;
    s.set_picture(truth);
    const Fit fit = s.fit.refine(fit_of(s.seen));
    return glm::dvec2(fit.offsets[right].x, fit.offsets[left].x) - glm::dvec2(s.seen.control[right].x);
  };
  const glm::dvec2 aside = found(300, 300), apart = found(300, -300);
  EXPECT_NEAR(aside.x, 300, 100);
  EXPECT_NEAR(aside.y, 300, 100);
  EXPECT_LT(std::abs(apart.x - apart.y), 0.85 * 600) << "though the picture says so";
}

// The least eigenvalue of a sum of squares is not below zero, but for rounding.
TEST(PictureFit, CostIsSymmetricAndPositiveSemidefinite) {
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

TEST(PictureFit, CostOfAShutMouthIgnoresItsInterior) {
  FittedScene s;
  s.set_picture(s.seen);
  const PictureCost cost = s.fit.cost_at(fit_of(s.seen));
  for (int i = 0; i < kParameterCount; ++i)
    if (kPartOf[i] == static_cast<int>(PartId::kMouthInterior)) {
      EXPECT_EQ(cv::countNonZero(cost.quadratic().row(i)), 0) << i;
    }
}

// The encoder's cost matches the decoder's picture, though it compares some thousand points where the decoder
// has all samples.
TEST(PictureFit, CostPredictsTheChangeOfTheSquaredDifference) {
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

/// A pattern seen somewhere, and a picture of the same face in another paint.
struct CostCase {
  SeenScene scene;
  PictureFit fit;
  Picture source;

  CostCase(const State& seen, const State& truth, int index = 0)
      : scene(seen, wave_plane(SeenScene::kWidth, SeenScene::kHeight, 7)),
        fit(scene.scene.setup, toy_geometry(),
            {SeenScene::frame_of(scene.scene.patterns[0].picture), seen, index}),
        source(scene.drawn(truth)) {
    const Plane other = wave_plane(SeenScene::kWidth, SeenScene::kHeight, 8);
    for (std::size_t i = 0; i < source.y.samples.size(); ++i)
      source.y.samples[i] = static_cast<std::uint8_t>(source.y.samples[i] + (other.samples[i] - 128) / 4);
    set(source);
  }
  void set(const Picture& picture) { fit.set_picture(SeenScene::frame_of(picture)); }

  /// Over the samples of the head as the decoder draws it.
  [[nodiscard]] double drawn_difference(const State& state) const {
    const OwnerMap owners(scene.scene.geometry->screen_mesh(state));
    const Picture drawn = scene.drawn(state);
    double sum = 0;
    for (std::size_t i = 0; i < drawn.y.samples.size(); ++i)
      if (owners.on_head(i)) sum += huber(drawn.y.samples[i] - source.y.samples[i]);
    return sum;
  }
};

State some_state(unsigned seed) {
  StateMaker maker(seed);
  State state = SeenScene::rest();
  maker.pose(state);
  maker.expression(state);
  maker.light(state);
  return state;
}

TEST(PictureFit, CostIsTheDifferenceThatTheDecoderDraws) {
  for (const State& seen : {SeenScene::rest(), some_state(2)}) {
    const State truth = some_state(1);
    const CostCase c(seen, truth);
    const PictureCost cost = c.fit.cost_at(fit_of(truth));
    const double drawn = c.drawn_difference(truth);
    EXPECT_NEAR(cost.constant() / drawn, 1, 0.05);
    // Both sides together: the source is no minimum.
    const auto expect_near = [&](int number, int by) {
      State up = truth, down = truth;
      (number < kPoseCount ? up.pose[number] : up.light[number - kPoseCount]) += by;
      (number < kPoseCount ? down.pose[number] : down.light[number - kPoseCount]) -= by;
      const double there = 0.5 * (c.drawn_difference(up) + c.drawn_difference(down));
      const double predicted = cost.constant() + cost.quadratic()(number, number) * by * by;
      EXPECT_GT(there, 1.2 * drawn) << number << " moves it enough to tell";
      // Points of small triangles stand for less than they count in the quadratic.
      EXPECT_NEAR(predicted / there, 1, 0.65) << number;
    };
    expect_near(kShiftX, 96);
    expect_near(kShiftY, 96);
    expect_near(kYaw, 3 * kDegree);
    expect_near(kPoseCount + kLightOffset, 16 * 8);
    expect_near(kPoseCount + kLightSlopeX, 16 * 12);
  }
}

TEST(PictureFit, CostNamesThePatternAndIsLowerForTheOneThatShowsMore) {
  State open = with_open_mouth(some_state(3));
  open.light = {200, 0, -100};
  const CostCase shut(SeenScene::rest(), open);
  // The same face as the source, seen as it is now.
  const Picture& source = shut.source;
  const auto cost_of_pattern = [&](const Picture& picture, const State& seen, int index) {
    PictureFit fit(shut.scene.scene.setup, toy_geometry(), {SeenScene::frame_of(picture), seen, index});
    fit.set_picture(SeenScene::frame_of(source));
    return fit.cost_at(fit_of(open)).layers.at(0);
  };
  const LayerCost first = cost_of_pattern(shut.scene.scene.patterns[0].picture, SeenScene::rest(), 0);
  const LayerCost second = cost_of_pattern(source, open, 3);
  EXPECT_EQ(first.pattern, 0);
  EXPECT_EQ(second.pattern, 3);
  EXPECT_LT(second.constant, 0.1 * first.constant);
}

TEST(PictureFit, CostNearAStartIsThatAtARefinedFit) {
  FittedScene s;
  State truth = s.seen, start = s.seen;
  truth.pose[kShiftX] += 32;
  truth.light[kLightOffset] += 4 * 16;
  s.set_picture(truth);
  const PictureCost near = s.fit.cost_near(fit_of(start)), at = s.fit.cost_at(s.fit.refine(fit_of(start)));
  EXPECT_NEAR(near.fit[kShiftX], at.fit[kShiftX], 0.1 * 32);
  EXPECT_LT(cv::norm(near.quadratic() - at.quadratic()), 0.1 * cv::norm(at.quadratic()));
}

// A blend that is about to change is no reason for another light.
TEST(PictureFit, OneStepIsNotTakenToAPictureOfAnotherBrightness) {
  FittedScene s;
  State truth = s.seen;
  const State start = s.seen;
  truth.light[kLightOffset] += 40 * 16;
  s.set_picture(truth);
  EXPECT_EQ(s.fit.cost_near(fit_of(start)).fit[kPoseCount + kLightOffset], start.light[kLightOffset]);
}

// A picture that was drawn with a mouth interior shows how the interior's colours should change.
TEST(PictureFit, APatternDrawnWithAnInteriorLeavesItsColoursFree) {
  FittedScene s;
  const State open = with_open_mouth(s.seen);
  State brighter = open;
  brighter.interior.fill(24 * 16);
  const WorkFrame drawn = WorkFrame::cut(s.drawn(open), {160, 96}, 48, false);
  const auto fitted = [&](double opacity) {
    s.fit.set_pattern({drawn, open, 0, opacity});
    s.set_picture(brighter);
    const PictureCost cost = s.fit.cost_near(fit_of(open));
    return cost.fit[first_of(PartId::kMouthInterior) + kInteriorMiddle];
  };
  EXPECT_EQ(fitted(0), 0);
  EXPECT_GT(fitted(1), 8 * 16);
  EXPECT_LT(fitted(1), 28 * 16);
}

}  // namespace
}  // namespace fbs
