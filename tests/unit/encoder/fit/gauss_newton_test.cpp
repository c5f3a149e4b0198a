#include "encoder/fit/gauss_newton.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/encoder/fit/fitted_scene.h"
#include "tests/unit/encoder/fit/seen_scene.h"

namespace fbs {
namespace {

constexpr double kDegreeRad = std::numbers::pi / 180;

TEST(GaussNewton, FindsPoseAndExpression) {
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

TEST(GaussNewton, StaysWhereThePictureIsThePattern) {
  FittedScene s;
  s.set_picture(s.seen);
  const Pose start = pose_of(s.seen);
  const Fit found = s.fit.refine({start, {}, {}});
  EXPECT_NEAR(found.pose.yaw, start.yaw, 0.3 * kDegreeRad);
  EXPECT_NEAR(found.pose.shift.x, start.shift.x, 0.1);
  EXPECT_NEAR(found.pose.shift.y, start.shift.y, 0.1);
  for (const glm::dvec2 o : found.offsets) EXPECT_LT(std::hypot(o.x, o.y), 0.02 * kUnitsPerEyeDistance);
}

TEST(GaussNewton, MovesNoPartsThatAreNotSent) {
  FittedScene s;
  fbs::Setup few = s.setup;
  few.parts = static_cast<PartMask>(mask_of(PartId::kPose) | mask_of(PartId::kBrows));
  PictureFit fit(few, toy_geometry(),
                 {WorkFrame::cut(s.scene.patterns[0].picture, {160, 96}, 48, true), s.seen});
  fit.set_picture(WorkFrame::cut(s.drawn(other_state(s)), {160, 96}, 48, true));
  const Fit found = fit.refine({pose_of(s.seen), {}, {}});
  const ExpressionPart& brows = generic_head().expression[1];
  for (int i = 0; i < kControlCount; ++i) {
    const bool sent = i >= brows.first_control && i < brows.first_control + brows.control_count;
    EXPECT_EQ(found.offsets[i] != glm::dvec2(0), sent) << i;
  }
}

TEST(GaussNewton, FindsLight) {
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

TEST(GaussNewton, FindsTheMouthInterior) {
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

// A face that has left: nothing to fit, nothing that may go wild.
TEST(GaussNewton, IsNotCarriedFarByAFlatPicture) {
  FittedScene s;
  s.fit.set_picture(WorkFrame::cut(Picture(320, 240), {160, 96}, 48, true));
  const Pose start = pose_of(s.seen);
  const Fit found = s.fit.refine({start, {}, {}});
  EXPECT_TRUE(std::isfinite(found.pose.yaw) && std::isfinite(found.pose.shift.x));
  for (const glm::dvec2 o : found.offsets) EXPECT_TRUE(std::isfinite(o.x) && std::isfinite(o.y));
}

// A pattern with a light, an expression and an open mouth of its own serves as well as one at rest.
TEST(GaussNewton, FindsTheStateFromAPatternSeenInAnyOther) {
  StateMaker maker(11);
  const auto any = [&] {
    State state = SeenScene::rest();
    maker.pose(state);
    maker.light(state);
    maker.mouth(state);
    return state;
  };
  const State seen = any();
  SeenScene scene(seen, smooth_plane(SeenScene::kWidth, SeenScene::kHeight, 1));
  const State truth = any();
  scene.set_picture(scene.drawn(truth));
  Fit start = fit_of(truth);
  start.pose.yaw += 2 * kDegreeRad;
  start.pose.shift += glm::dvec2(1.5, -1);
  start.light = {};
  const Fit found = gauss_newton(scene.comparison, start);
  EXPECT_NEAR(found.pose.yaw, fit_of(truth).pose.yaw, kDegreeRad);
  EXPECT_NEAR(found.pose.shift.x, fit_of(truth).pose.shift.x, 0.3);
  EXPECT_NEAR(found.pose.shift.y, fit_of(truth).pose.shift.y, 0.3);
  for (std::size_t i = 0; i < kLightCount; ++i) EXPECT_NEAR(found.light[i], fit_of(truth).light[i], 3) << i;
  const Picture source = scene.drawn(truth);
  EXPECT_LT(squares(scene.drawn(state_of(found)), source),
            0.1 * squares(scene.drawn(state_of(start)), source));
}

}  // namespace
}  // namespace fbs
