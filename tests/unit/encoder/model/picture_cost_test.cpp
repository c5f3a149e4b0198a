#include "encoder/model/picture_cost.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

State some_state() {
  State state = toy_state();
  state.pose[kYaw] = 500;
  state.light = {160, -32, 80, 16};
  state.interior = {48, -16, 7};
  for (std::size_t c = 0; c < kControlCount; ++c) state.control[c] = {20 * static_cast<int>(c), -300};
  return state;
}

cv::Mat1d some_quadratic() {
  cv::Mat1d half(kFitNumbers, kFitNumbers);
  cv::RNG random(1);
  random.fill(half, cv::RNG::UNIFORM, -1.0, 1.0);
  return half.t() * half;
}

TEST(PictureCost, HasTheNumbersOfTheFit) {
  const State state = some_state();
  for (const PictureCost& cost :
       {cost_of(fit_of(state), 0, 1, some_quadratic()), cost_unseen(fit_of(state))}) {
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

// The same step in the fit's numbers and in those that are coded costs the same.
TEST(PictureCost, IsTheQuadraticOfTheFitInUnitsOfTheState) {
  const cv::Mat1d quadratic = some_quadratic();
  const Fit fit = fit_of(some_state());
  Fit other = fit;
  other.pose.yaw += 0.01;
  other.pose.shift.x -= 2;
  other.light[2] += 3;
  other.interior[1] -= 5;
  other.offsets[4] += glm::dvec2(100, -50);
  other.offsets[30] += glm::dvec2(-20, 70);
  const std::array<double, 2> pose = {0.01, -2};
  cv::Mat1d own = cv::Mat1d::zeros(kFitNumbers, 1);
  own(kYaw) = pose[0], own(kShiftX) = pose[1];
  own(kPoseCount + 2) = 3, own(kPoseCount + kLightCount + 1) = -5;
  own(kFitOffsets + 8) = 100, own(kFitOffsets + 9) = -50, own(kFitOffsets + 60) = -20,
                    own(kFitOffsets + 61) = 70;
  const PictureCost here = cost_of(fit, 2, 10, quadratic), there = cost_of(other, 2, 10, quadratic);
  cv::Mat1d step = cv::Mat1d::zeros(kParameterCount, 1);
  for (std::size_t i = 0; i < kParameterCount; ++i) step(static_cast<int>(i)) = there.fit[i] - here.fit[i];
  const double expected = cv::Mat1d(own.t() * quadratic * own)(0);
  EXPECT_NEAR(cv::Mat1d(step.t() * here.quadratic() * step)(0), expected, 1e-3 * expected);
  EXPECT_EQ(here.constant(), 10);
  EXPECT_EQ(here.layers.at(0).pattern, 2);
}

TEST(PictureCost, SumsItsRegions) {
  PictureCost cost = cost_of(fit_of(some_state()), 0, 10, some_quadratic());
  const double before = cost.quadratic()(kYaw, kYaw);
  cv::Mat1d more = cv::Mat1d::zeros(kParameterCount, kParameterCount);
  more(kYaw, kYaw) = 5;
  cost.layers.push_back({CostLayer::kSurround, 0, 7, more});
  EXPECT_EQ(cost.constant(), 17);
  EXPECT_DOUBLE_EQ(cost.quadratic()(kYaw, kYaw), before + 5);
}

TEST(PictureCost, UnseenHoldsThePoseAlone) {
  const cv::Mat1d cost = cost_unseen(fit_of(toy_state())).quadratic();
  for (int i = 0; i < kParameterCount; ++i)
    for (int j = 0; j < kParameterCount; ++j)
      EXPECT_EQ(cost(i, j) > 0, i == j && i < kPoseCount) << i << ' ' << j;
}

}  // namespace
}  // namespace fbs
