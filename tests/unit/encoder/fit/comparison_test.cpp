#include "encoder/fit/comparison.h"

#include <gtest/gtest.h>

#include "tests/unit/encoder/fit/owner_map.h"
#include "tests/unit/encoder/fit/seen_scene.h"

namespace fbs {
namespace {

constexpr int kWidth = SeenScene::kWidth, kHeight = SeenScene::kHeight;

State some_state(unsigned seed) {
  StateMaker maker(seed);
  State state = SeenScene::rest();
  maker.pose(state);
  maker.expression(state);
  maker.light(state);
  return state;
}

TEST(Comparison, HuberIsSquaredAndThenLinearWithoutAStep) {
  EXPECT_EQ(huber(-3), 9);
  EXPECT_NEAR(huber(kHuberLevels - 1e-9), huber(kHuberLevels + 1e-9), 1e-6);
  EXPECT_NEAR(huber(3 * kHuberLevels) - huber(2 * kHuberLevels), 2 * kHuberLevels * kHuberLevels, 1e-9);
}

TEST(Comparison, MeanDifferenceIsThatOfRoundingAndFoldsInTheTrueState) {
  const State truth = some_state(1);
  SeenScene scene(some_state(2), wave_plane(kWidth, kHeight, 1));
  scene.set_picture(scene.drawn(truth));
  EXPECT_LT(mean_difference(scene.comparison, fit_of(truth)), 3);
  EXPECT_GT(mean_difference(scene.comparison, fit_of(scene.seen)), 50);
}

TEST(Comparison, NothingIsDifferentWhereNothingIsSeen) {
  const SeenScene scene(SeenScene::rest(), wave_plane(kWidth, kHeight, 1));
  EXPECT_EQ(mean_difference(scene.comparison, fit_of(scene.seen)), 0) << "no picture yet";
}

TEST(Comparison, AddPictureReturnsTheDifferenceOverTheHeadsSamples) {
  const State truth = some_state(1);
  SeenScene scene(SeenScene::rest(), wave_plane(kWidth, kHeight, 1));
  const Picture drawn = scene.drawn(truth);
  Picture other(kWidth, kHeight);
  other.y = wave_plane(kWidth, kHeight, 9);
  scene.set_picture(other);
  const OwnerMap owners(scene.scene.geometry->screen_mesh(truth));
  double sum = 0;
  for (std::size_t i = 0; i < other.y.samples.size(); ++i)
    if (owners.on_head(i)) sum += huber(drawn.y.samples[i] - other.y.samples[i]);
  NormalEquations normal(scene.comparison.columns.count());
  EXPECT_NEAR(add_picture(scene.comparison, 0, fit_of(truth), normal) / sum, 1, 0.02);
}

// The right side is the negative half of the gradient, column by column.
TEST(Comparison, EquationsDescendTheDifference) {
  SeenScene scene(SeenScene::rest(), wave_plane(kWidth, kHeight, 1));
  scene.set_picture(scene.drawn(some_state(1)));
  StateMaker maker(3);
  State open = SeenScene::rest();
  maker.mouth(open);
  maker.light(open);
  const Fit fit = fit_of(open);
  const Comparison& c = scene.comparison;
  NormalEquations normal(c.columns.count());
  (void)add_picture(c, 0, fit, normal);
  const auto sum = [&](const Fit& at) {
    return mean_difference(c, at) * static_cast<double>(c.points.size()) / (kResidualSigma * kResidualSigma);
  };
  const auto expect = [&](std::size_t column, double step, auto&& number_of) {
    Fit up = fit, down = fit;
    number_of(up) += step;
    number_of(down) -= step;
    const double slope = (sum(up) - sum(down)) / (2 * step);
    const double most = std::sqrt(normal.left(column, column) * sum(fit));  // Cauchy-Schwarz
    EXPECT_NEAR(normal.right(column), -0.5 * slope, 0.05 * std::abs(slope) + 0.02 * most) << column;
  };
  expect(kYaw, 0.004, [](Fit& f) -> double& { return f.pose.yaw; });
  expect(kShiftX, 0.2, [](Fit& f) -> double& { return f.pose.shift.x; });
  expect(kShiftY, 0.2, [](Fit& f) -> double& { return f.pose.shift.y; });
  expect(kLogScale, 0.004, [](Fit& f) -> double& { return f.pose.log2_scale; });
  for (std::size_t i = 0; i < kLightCount; ++i)
    expect(FitColumns::kFirstLight + i, 0.1, [i](Fit& f) -> double& { return f.light[i]; });
  for (std::size_t i = 0; i < kInteriorCount; ++i)
    expect(FitColumns::kFirstInterior + i, 0.1, [i](Fit& f) -> double& { return f.interior[i]; });
  const std::size_t brow = feature(FeatureId::kBrowLeft).first_control + 1U;
  expect(c.columns.of(brow) + 1, 20, [brow](Fit& f) -> double& { return f.offsets[brow].y; });
}

}  // namespace
}  // namespace fbs
