// Each energy term of the B-snake on its own, against values worked out by hand, and its gradient.
#include "encoder/track/snake/b_snake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "tests/unit/encoder/track/snake/toy_snake.h"

namespace fbs {
namespace {

// Eq. 3 on a straight line of length L: v_s = L everywhere.
TEST(BSnake, TensionEnergyOfALineIsItsSquaredLength) {
  ToySnake b;
  b.curve = SnakeCurve::clamped(13);
  b.rest = b.before = Control(4);
  b.weights.tension = 0.5;
  const Control line = {{0, 0}, {2, 0}, {4, 0}, {6, 0}};
  EXPECT_NEAR(b.snake().energy(line), 0.5 * 36 * 13 / 12, 1e-9);
  b.weights = {};
  b.weights.rigidity = 1;
  EXPECT_NEAR(b.snake().energy(line), 0, 1e-9) << "a line is not bent";
}

double energy_of(ToySnake b, const SnakeWeights& weights, const Control& control) {
  b.weights = weights;
  return b.snake().energy(control);
}

constexpr std::array<double SnakeWeights::*, 6> kTerms = {&SnakeWeights::tension,   &SnakeWeights::rigidity,
                                                          &SnakeWeights::temporal,  &SnakeWeights::shape,
                                                          &SnakeWeights::repulsion, &SnakeWeights::contrast};

/// A snake on which every term is active.
struct EveryTerm : ToySnake {
  Control now = ellipse({15, 7}, {1, 2});

  EveryTerm() {
    image = contrast_of([](glm::dvec2 p) { return soft_step(length(p) - 12); });
    before = circle(11, {-1, 0});
    for (int h = 3; h <= kPoints / 2 - 3; ++h) facing.push_back({h, kPoints - h, {0, 1}, 20});
  }
};

TEST(BSnake, AreSwitchedOffByAZeroWeight) {
  const EveryTerm e;
  EXPECT_EQ(energy_of(e, {}, e.now), 0);
}

TEST(BSnake, AddUpAndNoneNeedsAnother) {
  const EveryTerm e;
  SnakeWeights all;
  double sum = 0;
  for (std::size_t k = 0; k < kTerms.size(); ++k) {
    SnakeWeights one;
    one.*kTerms[k] = all.*kTerms[k] = 0.1 * static_cast<double>(k + 1);
    const double alone = energy_of(e, one, e.now);
    EXPECT_GT(std::abs(alone), 1e-3) << "term " << k << " is silent";
    sum += alone;
  }
  EXPECT_NEAR(energy_of(e, all, e.now), sum, 1e-9 * std::abs(sum));
}

TEST(BSnake, AreProportionalToTheirWeights) {
  const EveryTerm e;
  for (std::size_t k = 0; k < kTerms.size(); ++k) {
    SnakeWeights one, three;
    one.*kTerms[k] = 1;
    three.*kTerms[k] = 3;
    const double value = energy_of(e, one, e.now);
    EXPECT_NEAR(energy_of(e, three, e.now), 3 * value, 1e-9 * std::abs(value)) << "term " << k;
  }
}

// E_int counts as it is, E_img with the other sign (eq. 1): only what attracts has negative energy.
TEST(BSnake, InternalEnergyIsAPenaltyAndTheImagesAReward) {
  const EveryTerm e;
  for (std::size_t k = 0; k < kTerms.size(); ++k) {
    SnakeWeights one;
    one.*kTerms[k] = 1;
    const double value = energy_of(e, one, e.now);
    EXPECT_EQ(value < 0, k >= 5) << "term " << k << ": " << value;
  }
}

// The gradient that sign descent uses, against the difference of the energies on either side.
void expect_slope_of_energy(const ToySnake& b, const Control& at, double tolerance) {
  constexpr double kEither = 0.01;  // snake units; maps have kinks at their samples
  const BSnake snake = b.snake();
  const Control gradient = snake.gradient(at);
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (int axis = 0; axis < 2; ++axis) {
      Control above = at, below = at;
      above[i][axis] += kEither;
      below[i][axis] -= kEither;
      const double slope = (snake.energy(above) - snake.energy(below)) / (2 * kEither);
      EXPECT_NEAR(gradient[i][axis], slope, tolerance) << "control " << i << " axis " << axis;
    }
  }
}

TEST(BSnake, GradientOfEachIsTheSlopeOfItsEnergy) {
  EveryTerm e;
  for (std::size_t k = 0; k < kTerms.size(); ++k) {
    e.weights = {};
    e.weights.*kTerms[k] = 0.3;
    SCOPED_TRACE("term " + std::to_string(k));
    double largest = 0;
    for (const glm::dvec2 g : e.snake().gradient(e.now)) largest = std::max(largest, length(g));
    EXPECT_GT(largest, 1e-3);
    expect_slope_of_energy(e, e.now, 0.02 * largest);
  }
}

TEST(BSnake, GradientOfARidgeIsTheSlopeOfItsEnergy) {
  ToyLine b;
  b.image.ridge = painted([](glm::dvec2 p) { return std::exp(-(p.y - 2) * (p.y - 2) / 8); });
  b.weights.contrast = 1;
  expect_slope_of_energy(b, moved(line(9), {-3.1, 0.4}), 1e-3);
}

// Outside, the border's samples are repeated: nothing slopes there.
TEST(BSnake, MapsAreFlatOutside) {
  ToyLine b;
  b.image.ridge = painted([](glm::dvec2 p) { return 20 + 0.5 * p.x + 0.25 * p.y; });
  b.weights.contrast = 1;
  for (const glm::dvec2 g : b.snake().gradient(moved(line(6), {100, 0}))) {
    EXPECT_EQ(g.x, 0);
    EXPECT_LT(g.y, 0);
  }
}

TEST(BSnake, TensionOfEq3IsTheSquareOfTheLengthWhereverTheLineLies) {
  const ToyLine b;
  EXPECT_NEAR(energy_of(b, {.tension = 2}, line(5)), 2 * 25 * ToyLine::kWhole, 1e-9);
  EXPECT_NEAR(energy_of(b, {.tension = 2}, moved(line(5), {7, -3})), 2 * 25 * ToyLine::kWhole, 1e-9);
}

// A parabola x = L s, y = 4 h s (1 - s), as a cubic; v_ss = (0, -8 h) everywhere.
TEST(BSnake, RigidityOfEq4IsTheSquareOfTheSecondDerivative) {
  constexpr double kLength = 9, kHeight = 1.5;
  const Control parabola = {
      {0, 0}, {kLength / 3, 4 * kHeight / 3}, {2 * kLength / 3, 4 * kHeight / 3}, {kLength, 0}};
  EXPECT_NEAR(energy_of(ToyLine(), {.rigidity = 0.5}, parabola),
              0.5 * 64 * kHeight * kHeight * ToyLine::kWhole, 1e-9);
}

TEST(BSnake, TemporalTermOfEq5IsTheSquareOfTheDisplacementSinceThePictureBefore) {
  ToySnake b;
  b.before = circle(10, {3, 4});
  b.rest = circle(2);  // not used by this term
  EXPECT_NEAR(energy_of(b, {.temporal = 0.5}, circle(10)), 0.5 * 25 * kControls, 1e-9);
  EXPECT_NEAR(energy_of(b, {.temporal = 0.5}, b.before), 0, 1e-9);
}

// Not in the paper: difference from the rest's slope, wherever the curve lies.
TEST(BSnake, ShapeTermIsTheSquareOfTheSlopesDifferenceFromRest) {
  ToyLine b;
  b.rest = line(4);
  EXPECT_NEAR(energy_of(b, {.shape = 0.5}, line(7)), 0.5 * 9 * ToyLine::kWhole, 1e-9);
  EXPECT_NEAR(energy_of(b, {.shape = 0.5}, moved(line(4), {5, -6})), 0, 1e-9);
}

// The feature map rises downwards by 1 a unit. The normal of a curve that runs to the right points up, and
// the contrast is the map's fall along it.
TEST(BSnake, ContrastOfEq7IsTheFallAlongTheNormalWhateverTheSpeed) {
  ToyLine b;
  b.image.contrast_y = painted([](glm::dvec2) { return 1.0; });
  b.image.contrast_x = painted([](glm::dvec2) { return 5.0; });  // along the line: no contrast across it
  for (const double length_units : {4.0, 12.0})
    EXPECT_NEAR(energy_of(b, {.contrast = 0.5}, line(length_units)), -0.5 * ToyLine::kWhole, 1e-6);
  Control back = line(12);
  std::reverse(back.begin(), back.end());
  EXPECT_NEAR(energy_of(b, {.contrast = 0.5}, back), 0.5 * ToyLine::kWhole, 1e-6) << "inside out";
}

TEST(BSnake, RepulsionIsTheSquareOfWhatTheGapLacksAlongItsDirection) {
  ToyLine b;
  b.facing = {{0, 12, {1, 0}, 9}};
  const double ds = b.curve.ds();
  EXPECT_NEAR(energy_of(b, {.repulsion = 0.5}, line(7)), 0.5 * 4 * ds, 1e-9);
  EXPECT_EQ(energy_of(b, {.repulsion = 0.5}, line(9.5)), 0);
  Control steep = line(7);
  for (glm::dvec2& p : steep) p.y = 3 * p.x;  // longer, but not along the direction
  EXPECT_NEAR(energy_of(b, {.repulsion = 0.5}, steep), 0.5 * 4 * ds, 1e-9);
}

TEST(BSnake, RepulsionIsSilentWhileTheGapIsWide) {
  ToySnake b;
  b.weights.repulsion = 1;
  for (int h = 3; h <= kPoints / 2 - 3; ++h) b.facing.push_back({h, kPoints - h, {0, 1}, 4});
  EXPECT_EQ(b.snake().energy(ellipse({15, 12})), 0);
  EXPECT_GT(b.snake().energy(ellipse({15, 3})), 0);
}

}  // namespace
}  // namespace fbs
