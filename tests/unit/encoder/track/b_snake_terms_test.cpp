// Each energy term of the B-snake on its own, against values worked out by hand, and the descent's numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "tests/unit/encoder/track/toy_snake.h"

namespace fbs {
namespace {

/// A line of four control points from the origin, parallel to x: v_s = (length, 0) everywhere.
Control line(double length_units) {
  return {{0, 0}, {length_units / 3, 0}, {2 * length_units / 3, 0}, {length_units, 0}};
}

struct ToyLine : ToySnake {
  ToyLine() {
    curve = SnakeCurve::clamped(13);
    rest = before = Control(4);
  }
  /// The sum over the points times ds, of a term that is 1 everywhere.
  static constexpr double kWhole = 13.0 / 12;
};

double energy_of(ToySnake b, const SnakeWeights& weights, const Control& control) {
  b.weights = weights;
  return b.snake().energy(control);
}

constexpr std::array<double SnakeWeights::*, 7> kTerms = {
    &SnakeWeights::tension,   &SnakeWeights::rigidity, &SnakeWeights::temporal, &SnakeWeights::shape,
    &SnakeWeights::repulsion, &SnakeWeights::contrast, &SnakeWeights::change};

/// A snake on which every term has something to say.
struct EveryTerm : ToySnake {
  Control now = ellipse({15, 7}, {1, 2});

  EveryTerm() {
    image = contrast_of([](glm::dvec2 p) { return soft_step(length(p) - 12); });
    image.change = painted([](glm::dvec2 p) { return 0.3 + 0.01 * p.x; });
    before = circle(11, {-1, 0});
    for (int h = 3; h <= kPoints / 2 - 3; ++h) facing.push_back({h, kPoints - h, {0, 1}, 20});
  }
};

TEST(BSnakeTerms, AreSwitchedOffByAZeroWeight) {
  const EveryTerm e;
  EXPECT_EQ(energy_of(e, {}, e.now), 0);
}

TEST(BSnakeTerms, AddUpAndNoneNeedsAnother) {
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

TEST(BSnakeTerms, AreProportionalToTheirWeights) {
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
TEST(BSnakeTerms, InternalEnergyIsAPenaltyAndTheImagesAReward) {
  const EveryTerm e;
  for (std::size_t k = 0; k < kTerms.size(); ++k) {
    SnakeWeights one;
    one.*kTerms[k] = 1;
    const double value = energy_of(e, one, e.now);
    EXPECT_EQ(value < 0, k >= 5) << "term " << k << ": " << value;
  }
}

// What the sign descent goes by, against the difference of the energies either side.
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

TEST(BSnakeTerms, GradientOfEachIsTheSlopeOfItsEnergy) {
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

TEST(BSnakeTerms, GradientOfARidgeIsTheSlopeOfItsEnergy) {
  ToyLine b;
  b.image.ridge = painted([](glm::dvec2 p) { return std::exp(-(p.y - 2) * (p.y - 2) / 8); });
  b.weights = {.contrast = 1, .change = 0.2};
  b.image.change = painted([](glm::dvec2 p) { return 0.3 + 0.01 * p.x * p.y; });
  expect_slope_of_energy(b, moved(line(9), {-3.1, 0.4}), 1e-3);
}

// Outside, the border's samples are repeated: nothing slopes there.
TEST(BSnakeTerms, MapsAreFlatOutside) {
  ToyLine b;
  b.image.change = painted([](glm::dvec2 p) { return 20 + 0.5 * p.x + 0.25 * p.y; });
  b.weights.change = 1;
  for (const glm::dvec2 g : b.snake().gradient(moved(line(6), {100, 0}))) {
    EXPECT_EQ(g.x, 0);
    EXPECT_LT(g.y, 0);
  }
}

TEST(BSnakeTerms, TensionOfEq3IsTheSquareOfTheLengthWhereverTheLineLies) {
  const ToyLine b;
  EXPECT_NEAR(energy_of(b, {.tension = 2}, line(5)), 2 * 25 * ToyLine::kWhole, 1e-9);
  EXPECT_NEAR(energy_of(b, {.tension = 2}, moved(line(5), {7, -3})), 2 * 25 * ToyLine::kWhole, 1e-9);
}

// A parabola x = L s, y = 4 h s (1 - s), as a cubic; v_ss = (0, -8 h) everywhere.
TEST(BSnakeTerms, RigidityOfEq4IsTheSquareOfTheSecondDerivative) {
  constexpr double kLength = 9, kHeight = 1.5;
  const Control parabola = {
      {0, 0}, {kLength / 3, 4 * kHeight / 3}, {2 * kLength / 3, 4 * kHeight / 3}, {kLength, 0}};
  EXPECT_NEAR(energy_of(ToyLine(), {.rigidity = 0.5}, parabola),
              0.5 * 64 * kHeight * kHeight * ToyLine::kWhole, 1e-9);
}

TEST(BSnakeTerms, TemporalTermOfEq5IsTheSquareOfTheWaySinceThePictureBefore) {
  ToySnake b;
  b.before = circle(10, {3, 4});
  b.rest = circle(2);  // which it does not look at
  EXPECT_NEAR(energy_of(b, {.temporal = 0.5}, circle(10)), 0.5 * 25 * kControls, 1e-9);
  EXPECT_NEAR(energy_of(b, {.temporal = 0.5}, b.before), 0, 1e-9);
}

// Not in the paper: what differs from the rest's slope, wherever the curve lies.
TEST(BSnakeTerms, ShapeTermIsTheSquareOfTheSlopesDifferenceFromRest) {
  ToyLine b;
  b.rest = line(4);
  EXPECT_NEAR(energy_of(b, {.shape = 0.5}, line(7)), 0.5 * 9 * ToyLine::kWhole, 1e-9);
  EXPECT_NEAR(energy_of(b, {.shape = 0.5}, moved(line(4), {5, -6})), 0, 1e-9);
}

// The feature map rises downwards by 1 a unit. The normal of a curve that runs to the right points up, and
// the contrast is the map's fall along it.
TEST(BSnakeTerms, ContrastOfEq7IsTheFallAlongTheNormalWhateverTheSpeed) {
  ToyLine b;
  b.image.contrast_y = painted([](glm::dvec2) { return 1.0; });
  b.image.contrast_x = painted([](glm::dvec2) { return 5.0; });  // along the line: no contrast across it
  for (const double length_units : {4.0, 12.0})
    EXPECT_NEAR(energy_of(b, {.contrast = 0.5}, line(length_units)), -0.5 * ToyLine::kWhole, 1e-6);
  Control back = line(12);
  std::reverse(back.begin(), back.end());
  EXPECT_NEAR(energy_of(b, {.contrast = 0.5}, back), 0.5 * ToyLine::kWhole, 1e-6) << "inside out";
}

TEST(BSnakeTerms, ChangeOfEq8IsItsMeanOverTheCurve) {
  ToyLine b;
  b.image.change = painted([](glm::dvec2 p) { return 1 + 0.5 * p.y; });
  EXPECT_NEAR(energy_of(b, {.change = 0.5}, line(6)), -0.5 * ToyLine::kWhole, 1e-6);
  EXPECT_NEAR(energy_of(b, {.change = 0.5}, moved(line(6), {0, 2})), -0.5 * 2 * ToyLine::kWhole, 1e-6);
}

TEST(BSnakeTerms, RepulsionIsTheSquareOfWhatTheGapLacksAlongItsDirection) {
  ToyLine b;
  b.facing = {{0, 12, {1, 0}, 9}};
  const double ds = b.curve.ds();
  EXPECT_NEAR(energy_of(b, {.repulsion = 0.5}, line(7)), 0.5 * 4 * ds, 1e-9);
  EXPECT_EQ(energy_of(b, {.repulsion = 0.5}, line(9.5)), 0);
  Control steep = line(7);
  for (glm::dvec2& p : steep) p.y = 3 * p.x;  // longer, but not along the direction
  EXPECT_NEAR(energy_of(b, {.repulsion = 0.5}, steep), 0.5 * 4 * ds, 1e-9);
}

// What repulsion does for brows: their length is taken as constant.
TEST(BSnakeTerms, RepulsionOfItsEndsKeepsABrowsLength) {
  const auto settled_length = [](double repulsion) {
    ToyLine b;
    b.weights = {.tension = 0.01, .repulsion = repulsion};
    b.facing = {{0, 12, {1, 0}, 12}};
    const auto p = b.settled(line(12));
    return p.back().x - p.front().x;
  };
  EXPECT_LT(settled_length(0), 8);
  EXPECT_GT(settled_length(4), 11);
}

/// A potential that falls evenly to the right: every step of every control point goes there.
struct Slope : ToyLine {
  explicit Slope(double steepness) {
    image.change = painted([](glm::dvec2 p) { return 20 + 0.5 * p.x; });
    weights.change = steepness;
  }
  [[nodiscard]] SnakeOutcome fall() const { return minimise(line(6)); }
  static double way(const SnakeOutcome& out) { return out.control[0].x; }
};

// delta_q = sigma^q: whenever the stop rule ends a descent, the curve has gone (1 - sigma^n) / (1 - sigma).
TEST(BSnakeTerms, StepsBeginAtOneUnitAndShrinkByAQuarter) {
  std::array<bool, kMostIterations + 1> met{};
  for (double steepness = 1e-5; steepness < 1; steepness *= 1.1) {
    const SnakeOutcome out = Slope(steepness).fall();
    if (out.restarts > 0) break;
    ASSERT_LE(out.iterations, kMostIterations);
    met[out.iterations] = true;
    EXPECT_NEAR(Slope::way(out), (1 - std::pow(0.75, out.iterations)) / 0.25, 1e-9) << steepness;
  }
  for (std::size_t n = 1; n <= 4; ++n) EXPECT_TRUE(met[n]) << n << " iterations";
}

// The stop rule looks at the energy's change, not at the steps.
TEST(BSnakeTerms, TheFlatterTheEnergyTheSoonerADescentStops) {
  int before = 0;
  for (const double steepness : {1e-5, 6e-4, 2e-3, 8e-3}) {
    const int iterations = Slope(steepness).fall().iterations;
    EXPECT_GT(iterations, before) << steepness;
    before = iterations;
  }
  EXPECT_EQ(Slope(1e-5).fall().iterations, 1);
}

// A crest narrower than the first step: one step overshoots it to where everything is flat and the descent
// ends.
TEST(BSnakeTerms, ADescentThatOvershootsGivesBackTheBestItMet) {
  ToyLine b;
  b.weights.change = 1;
  b.image.change = painted([](glm::dvec2 p) { return std::abs(p.y) < 0.25 ? 1.0 : 0.0; });
  const Control beside = moved(line(6), {0, -0.2});
  const SnakeOutcome out = b.minimise(beside);
  EXPECT_GT(out.iterations, 1) << "it went somewhere";
  EXPECT_EQ(out.control, beside);
  EXPECT_EQ(out.energy, b.snake().energy(beside));
}

/// The curve is drawn to where it was in the picture before, `way` units to the right of where it starts.
SnakeOutcome drawn_over(double way) {
  ToySnake b;
  b.weights.temporal = 1;
  b.before = circle(10, {way, 0});
  return b.minimise(circle(10));
}

// The steps of one descent sum to 4 units.
TEST(BSnakeTerms, ADescentStartsAgainOnlyWhereItsStepsWereUsedUp) {
  EXPECT_EQ(drawn_over(2).restarts, 0);
  EXPECT_EQ(drawn_over(6).restarts, 1);
  EXPECT_EQ(drawn_over(9).restarts, 2);
}

TEST(BSnakeTerms, RestartsReachWhatOneDescentCannot) {
  for (const double way : {2.0, 6.0, 9.0}) {
    for (int i = 0; i < kControls; ++i) {
      const auto at = static_cast<std::size_t>(i);
      EXPECT_NEAR(drawn_over(way).control[at].x, circle(10)[at].x + way, 0.15) << way;
    }
  }
}

}  // namespace
}  // namespace fbs
