// Where the descent takes a curve, term by term, and its steps.
#include "encoder/track/snake/snake_descent.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/unit/encoder/track/snake/toy_snake.h"

namespace fbs {
namespace {

TEST(SnakeDescent, TensionShortensTheCurve) {
  ToySnake b;
  b.weights.tension = 1;
  const double before = mean_radius(curve_of(b.curve, circle(10)));
  EXPECT_LT(mean_radius(b.outline_after(circle(10))), before - 3);
}

TEST(SnakeDescent, RigidityStraightensTheCurve) {
  ToySnake b;
  b.curve = SnakeCurve::clamped(13);
  b.rest = b.before = Control(4);
  b.weights.rigidity = 1;
  const Control bent = {{-6, 0}, {-2, 4}, {2, -4}, {6, 0}};
  const auto bend = [](const Control& c) {
    return length(c[0] - 2.0 * c[1] + c[2]) + length(c[1] - 2.0 * c[2] + c[3]);
  };
  EXPECT_LT(bend(b.minimise(bent).control), 0.1 * bend(bent));
}

TEST(SnakeDescent, TemporalTermHoldsTheCurveWhereItWas) {
  ToySnake b;
  b.weights.temporal = 1;
  b.before = circle(10, {2, -1.5});
  const auto was = curve_of(b.curve, b.before), now = b.outline_after(circle(10));
  for (std::size_t i = 0; i < now.size(); ++i) EXPECT_LT(length(now[i] - was[i]), 0.15);
}

TEST(SnakeDescent, ShapeTermRestoresTheRestShapeAnywhere) {
  ToySnake b;
  b.weights.shape = 1;
  const Control elsewhere = moved(b.rest, {5, 3});
  EXPECT_NEAR(b.snake().energy(elsewhere), 0, 1e-9);
  Control dented = elsewhere;
  dented[2] += glm::dvec2(1.5, 2);
  dented[7] -= glm::dvec2(2, 0.5);
  EXPECT_LT(b.minimise(dented).energy, 0.03 * b.snake().energy(dented));
}

TEST(SnakeDescent, ContrastAttractsToACirclesEdgeFromBothSides) {
  ToySnake b;
  b.image = contrast_of([](glm::dvec2 p) { return soft_step(length(p) - 12); });
  b.weights.contrast = 1;
  for (const double radius : {10.5, 12.0, 14.5}) {
    for (const glm::dvec2 p : b.outline_after(circle(radius)))
      EXPECT_NEAR(length(p), 12, 0.5) << "from " << radius;
  }
}

// The feature map is high inside: a border at which it rises outwards is not the contour.
TEST(SnakeDescent, ContrastOfTheWrongSignDoesNotAttract) {
  ToySnake b;
  b.image = contrast_of([](glm::dvec2 p) { return 1 - soft_step(length(p) - 12); });
  b.weights.contrast = 1;
  EXPECT_GT(std::abs(mean_radius(b.outline_after(circle(11))) - 12), 1.5);
}

TEST(SnakeDescent, RidgeAttractsACurveToTheMiddleOfABand) {
  ToySnake b;
  b.curve = SnakeCurve::clamped(13);
  b.rest = b.before = Control(4);
  b.image.ridge = painted([](glm::dvec2 p) { return std::exp(-(p.y - 2) * (p.y - 2) / 8); });
  b.weights.contrast = 1;
  for (const glm::dvec2 p : b.outline_after({{-9, -1}, {-3, -1}, {3, -1}, {9, -1}})) EXPECT_NEAR(p.y, 2, 0.3);
}

// Paper, Fig. 1. Dark lips (feature 1) in which an opening shows bright teeth (-1: farther from the lips'
// colour than skin is). The upper contour's prediction has failed and lies on the teeth, from where the lower
// lip's inner border is in reach: it falls from lip to teeth just as a lip's outer border falls from lip to
// skin, and more steeply.
struct Teeth {
  ToySnake bench;
  Control start = ellipse({15, 7.6});
  static constexpr double kOuter = 7, kInner = 3.5;  // half heights of the lips and of the opening

  explicit Teeth(double min_gap, double repulsion) {
    bench.image = contrast_of([](glm::dvec2 p) {
      const auto inside = [&](glm::dvec2 radius) {
        return soft_step((length(p / radius) - 1) * 2.5 * radius.y);
      };
      return inside({14, kOuter}) - 2 * inside({10, kInner});
    });
    bench.weights = {.tension = 0.0012, .rigidity = 0.002, .repulsion = repulsion, .contrast = 1};
    for (int h = 3; h <= kPoints / 2 - 3; ++h) bench.facing.push_back({h, kPoints - h, {0, 1}, min_gap});
    for (std::size_t i = 1; i <= 4; ++i) start[i].y = -3;
  }

  /// Middle of the upper and of the lower contour.
  [[nodiscard]] std::array<double, 2> middles() const {
    const auto p = bench.outline_after(start);
    return {p[kPoints / 4].y, p[kPoints * 3 / 4].y};
  }
};

TEST(SnakeDescent, TeethCollapseTheContourWithoutRepulsion) {
  const auto [upper, lower] = Teeth(8.8, 0).middles();
  EXPECT_NEAR(upper, Teeth::kInner, 0.5) << "caught by the lower lip";
  EXPECT_NEAR(lower, Teeth::kOuter, 0.5);
}

TEST(SnakeDescent, RepulsionHoldsTheContourOpenBeforeTeeth) {
  const auto [upper, lower] = Teeth(8.8, 0.1).middles();
  EXPECT_GT(lower - upper, 8);
  EXPECT_NEAR(lower, Teeth::kOuter, 0.5);
}

TEST(SnakeDescent, RepulsionBringsTheContourBackToTheLipsBorder) {
  const auto [upper, lower] = Teeth(10, 0.3).middles();
  EXPECT_NEAR(upper, -Teeth::kOuter, 0.5);
  EXPECT_NEAR(lower, Teeth::kOuter, 0.5);
}

// The gap is signed: lips that have passed through each other come apart again.
TEST(SnakeDescent, RepulsionUncrossesLips) {
  ToySnake b;
  b.weights.repulsion = 1;
  for (int h = 3; h <= kPoints / 2 - 3; ++h) b.facing.push_back({h, kPoints - h, {0, 1}, 4});
  Control crossed = ellipse({15, 1});
  for (glm::dvec2& p : crossed) p.y = -p.y;
  const auto p = b.outline_after(crossed);
  EXPECT_GT(p[kPoints * 3 / 4].y - p[kPoints / 4].y, 3.5);
}

// delta_q = 0.75^q over 15 iterations, three descents: the curve's target lies out of reach, so that every
// control point makes every step.
TEST(SnakeDescent, StepsFollowThePapersSchedule) {
  ToySnake b;
  b.weights.temporal = 1;
  b.before = circle(10, {1000, -1000});
  const SnakeOutcome out = b.minimise(circle(10));
  double reach = 0;
  for (int q = 0; q < kMaxIterations; ++q) reach += std::pow(0.75, q);
  EXPECT_EQ(out.restarts, 2);
  EXPECT_EQ(out.iterations, 3 * kMaxIterations);
  for (std::size_t i = 0; i < kControls; ++i) {
    EXPECT_NEAR(out.control[i].x - circle(10)[i].x, 3 * reach, 1e-9);
    EXPECT_NEAR(out.control[i].y - circle(10)[i].y, -3 * reach, 1e-9);
  }
}

TEST(SnakeDescent, StopsWhenTheEnergyRests) {
  ToySnake b;
  const SnakeOutcome out = b.minimise(circle(10));
  EXPECT_EQ(out.iterations, 1);
  EXPECT_EQ(out.restarts, 0);
  EXPECT_EQ(out.control, circle(10));
}

TEST(SnakeDescent, NeedsNoMoreIterationsThanADescentHasWhenNear) {
  ToySnake b;
  b.image = contrast_of([](glm::dvec2 p) { return soft_step(length(p) - 12); });
  b.weights.contrast = 1;
  const SnakeOutcome out = b.minimise(circle(12.5));
  EXPECT_LE(out.iterations, kMaxIterations);
  EXPECT_EQ(out.restarts, 0);
}

TEST(SnakeDescent, NeverEndsWithMoreEnergyThanItBeganWith) {
  const Teeth teeth(8.8, 0.1);
  for (double radius = 3; radius < 25; radius += 0.7) {
    const Control start = ellipse({radius * 1.5, radius}, {radius - 10, 3});
    const SnakeOutcome out = teeth.bench.minimise(start);
    EXPECT_LE(out.energy, teeth.bench.snake().energy(start));
    EXPECT_NEAR(out.energy, teeth.bench.snake().energy(out.control), 1e-9);
    EXPECT_LE(out.iterations, 3 * kMaxIterations);
  }
}

TEST(SnakeDescent, PinnedEndsStay) {
  ToySnake b;
  b.curve = SnakeCurve::clamped(11, false);
  b.rest = b.before = Control(4);
  b.weights.temporal = 1;
  const Control start = {{-6, 4}, {-2, 4}, {2, 4}, {6, 4}};
  const SnakeOutcome out = b.minimise(start);
  EXPECT_EQ(out.control[0], start[0]);
  EXPECT_EQ(out.control[3], start[3]);
  EXPECT_LT(out.energy, 0.5 * b.snake().energy(start)) << "the others move";
}

TEST(SnakeDescent, CurvesThatLeaveThePictureAreHarmless) {
  ToySnake b;
  b.image = contrast_of([](glm::dvec2 p) { return soft_step(length(p) - 12); });
  b.weights = {.tension = 0.001, .contrast = 1, .change = 1};
  for (const glm::dvec2 p : b.outline_after(circle(10, {500, -900})))
    EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
}

// Repulsion on brows: their length is assumed constant.
TEST(SnakeDescent, RepulsionOfItsEndsKeepsABrowsLength) {
  const auto length_after = [](double repulsion) {
    ToyLine b;
    b.weights = {.tension = 0.01, .repulsion = repulsion};
    b.facing = {{0, 12, {1, 0}, 12}};
    const auto p = b.outline_after(line(12));
    return p.back().x - p.front().x;
  };
  EXPECT_LT(length_after(0), 8);
  EXPECT_GT(length_after(4), 11);
}

/// A potential that falls evenly to the right: every step of every control point goes there.
struct Slope : ToyLine {
  explicit Slope(double steepness) {
    image.ridge = painted([](glm::dvec2 p) { return 20 + 0.5 * p.x; });
    weights.contrast = steepness;
  }
  [[nodiscard]] SnakeOutcome fall() const { return minimise(line(6)); }
  static double moved(const SnakeOutcome& out) { return out.control[0].x; }
};

// delta_q = sigma^q: whenever the stop rule ends a descent, the curve has gone (1 - sigma^n) / (1 - sigma).
TEST(SnakeDescent, StepsBeginAtOneUnitAndShrinkByAQuarter) {
  std::array<bool, kMaxIterations + 1> met{};
  for (double steepness = 1e-5; steepness < 1; steepness *= 1.1) {
    const SnakeOutcome out = Slope(steepness).fall();
    if (out.restarts > 0) break;
    ASSERT_LE(out.iterations, kMaxIterations);
    met[out.iterations] = true;
    EXPECT_NEAR(Slope::moved(out), (1 - std::pow(0.75, out.iterations)) / 0.25, 1e-9) << steepness;
  }
  for (std::size_t n = 1; n <= 4; ++n) EXPECT_TRUE(met[n]) << n << " iterations";
}

// The stop rule looks at the energy's change, not at the steps.
TEST(SnakeDescent, TheFlatterTheEnergyTheSoonerADescentStops) {
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
TEST(SnakeDescent, ADescentThatOvershootsGivesBackTheBestItMet) {
  ToyLine b;
  b.weights.contrast = 1;
  b.image.ridge = painted([](glm::dvec2 p) { return std::abs(p.y) < 0.25 ? 1.0 : 0.0; });
  const Control beside = moved(line(6), {0, -0.2});
  const SnakeOutcome out = b.minimise(beside);
  EXPECT_GT(out.iterations, 1) << "it went somewhere";
  EXPECT_EQ(out.control, beside);
  EXPECT_EQ(out.energy, b.snake().energy(beside));
}

/// Draws the curve to its position in the picture before, `displacement` units to the right of where it
/// starts.
SnakeOutcome drawn_over(double displacement) {
  ToySnake b;
  b.weights.temporal = 1;
  b.before = circle(10, {displacement, 0});
  return b.minimise(circle(10));
}

// The steps of one descent sum to 4 units.
TEST(SnakeDescent, ADescentStartsAgainOnlyWhereItsStepsWereUsedUp) {
  EXPECT_EQ(drawn_over(2).restarts, 0);
  EXPECT_EQ(drawn_over(6).restarts, 1);
  EXPECT_EQ(drawn_over(9).restarts, 2);
}

TEST(SnakeDescent, RestartsReachWhatOneDescentCannot) {
  for (const double d : {2.0, 6.0, 9.0}) {
    for (int i = 0; i < kControls; ++i) {
      const auto at = static_cast<std::size_t>(i);
      EXPECT_NEAR(drawn_over(d).control[at].x, circle(10)[at].x + d, 0.15) << d;
    }
  }
}

}  // namespace
}  // namespace fbs
