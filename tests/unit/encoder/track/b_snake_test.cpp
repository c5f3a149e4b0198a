#include "encoder/track/snake/b_snake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/unit/encoder/track/toy_snake.h"

namespace fbs {
namespace {

TEST(SnakeCurve, SupportIsWhereAControlPointMovesTheCurve) {
  for (const SnakeCurve& curve : {SnakeCurve::closed(kControls, kPoints), SnakeCurve::clamped(13)}) {
    for (int i = 0; i < curve.controls(); ++i) {
      Control still(static_cast<std::size_t>(curve.controls())), one = still;
      one[i] = {1, 1};
      for (int h = 0; h < static_cast<int>(curve.points().size()); ++h) {
        const bool moves = length(curve_point(curve.points()[h], one)) > 1e-9;
        const auto& support = curve.support(i);
        EXPECT_EQ(std::find(support.begin(), support.end(), h) != support.end(), moves) << i << ' ' << h;
      }
    }
  }
}

TEST(SnakeCurve, PointsAreEvenInTheParameter) {
  EXPECT_NEAR(SnakeCurve::closed(kControls, kPoints).ds() * kPoints, kControls, 1e-12);
  EXPECT_NEAR(SnakeCurve::clamped(13).ds() * 12, 1, 1e-12);
}

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

TEST(BSnake, TensionShortensTheCurve) {
  ToySnake b;
  b.weights.tension = 1;
  const double before = mean_radius(curve_of(b.curve, circle(10)));
  EXPECT_LT(mean_radius(b.settled(circle(10))), before - 3);
}

TEST(BSnake, RigidityStraightensTheCurve) {
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

TEST(BSnake, TemporalTermHoldsTheCurveWhereItWas) {
  ToySnake b;
  b.weights.temporal = 1;
  b.before = circle(10, {2, -1.5});
  const auto was = curve_of(b.curve, b.before), now = b.settled(circle(10));
  for (std::size_t i = 0; i < now.size(); ++i) EXPECT_LT(length(now[i] - was[i]), 0.15);
}

TEST(BSnake, ShapeTermRestoresTheRestShapeAnywhere) {
  ToySnake b;
  b.weights.shape = 1;
  const Control elsewhere = moved(b.rest, {5, 3});
  EXPECT_NEAR(b.snake().energy(elsewhere), 0, 1e-9);
  Control dented = elsewhere;
  dented[2] += glm::dvec2(1.5, 2);
  dented[7] -= glm::dvec2(2, 0.5);
  EXPECT_LT(b.minimise(dented).energy, 0.03 * b.snake().energy(dented));
}

TEST(BSnake, ContrastAttractsToACirclesEdgeFromBothSides) {
  ToySnake b;
  b.image = contrast_of([](glm::dvec2 p) { return soft_step(length(p) - 12); });
  b.weights.contrast = 1;
  for (const double radius : {10.5, 12.0, 14.5}) {
    for (const glm::dvec2 p : b.settled(circle(radius))) EXPECT_NEAR(length(p), 12, 0.5) << "from " << radius;
  }
}

// The feature map is high inside: a border at which it rises outwards is not the contour.
TEST(BSnake, ContrastOfTheWrongSignDoesNotAttract) {
  ToySnake b;
  b.image = contrast_of([](glm::dvec2 p) { return 1 - soft_step(length(p) - 12); });
  b.weights.contrast = 1;
  EXPECT_GT(std::abs(mean_radius(b.settled(circle(11))) - 12), 1.5);
}

TEST(BSnake, RidgeAttractsACurveToTheMiddleOfABand) {
  ToySnake b;
  b.curve = SnakeCurve::clamped(13);
  b.rest = b.before = Control(4);
  b.image.ridge = painted([](glm::dvec2 p) { return std::exp(-(p.y - 2) * (p.y - 2) / 8); });
  b.weights.contrast = 1;
  for (const glm::dvec2 p : b.settled({{-9, -1}, {-3, -1}, {3, -1}, {9, -1}})) EXPECT_NEAR(p.y, 2, 0.3);
}

TEST(BSnake, ChangeOfTheContrastAttracts) {
  ToySnake b;
  b.image.change = painted([](glm::dvec2 p) { return std::exp(-(length(p) - 12) * (length(p) - 12) / 6); });
  b.weights.change = 1;
  for (const glm::dvec2 p : b.settled(circle(12))) EXPECT_NEAR(length(p), 12, 0.6);
}

// Paper, Fig. 1. Dark lips (feature 1) in which an opening shows bright teeth (-1: farther from the lips'
// colour than skin is). The upper contour's prediction has failed and lies on the teeth, from where the lower
// lip's inner border is in reach: it falls from lip to teeth just as a lip's outer border falls from lip to
// skin, and more steeply.
struct Teeth {
  ToySnake bench;
  Control start = ellipse({15, 7.6});
  static constexpr double kOuter = 7, kInner = 3.5;  // half heights of the lips and of the opening

  explicit Teeth(double least_gap, double repulsion) {
    bench.image = contrast_of([](glm::dvec2 p) {
      const auto inside = [&](glm::dvec2 radius) {
        return soft_step((length(p / radius) - 1) * 2.5 * radius.y);
      };
      return inside({14, kOuter}) - 2 * inside({10, kInner});
    });
    bench.weights = {.tension = 0.0012, .rigidity = 0.002, .repulsion = repulsion, .contrast = 1};
    for (int h = 3; h <= kPoints / 2 - 3; ++h) bench.facing.push_back({h, kPoints - h, {0, 1}, least_gap});
    for (std::size_t i = 1; i <= 4; ++i) start[i].y = -3;
  }

  /// Middle of the upper and of the lower contour.
  [[nodiscard]] std::array<double, 2> middles() const {
    const auto p = bench.settled(start);
    return {p[kPoints / 4].y, p[kPoints * 3 / 4].y};
  }
};

TEST(BSnake, TeethCollapseTheContourWithoutRepulsion) {
  const auto [upper, lower] = Teeth(8.8, 0).middles();
  EXPECT_NEAR(upper, Teeth::kInner, 0.5) << "caught by the lower lip";
  EXPECT_NEAR(lower, Teeth::kOuter, 0.5);
}

TEST(BSnake, RepulsionHoldsTheContourOpenBeforeTeeth) {
  const auto [upper, lower] = Teeth(8.8, 0.1).middles();
  EXPECT_GT(lower - upper, 8);
  EXPECT_NEAR(lower, Teeth::kOuter, 0.5);
}

TEST(BSnake, RepulsionBringsTheContourBackToTheLipsBorder) {
  const auto [upper, lower] = Teeth(10, 0.3).middles();
  EXPECT_NEAR(upper, -Teeth::kOuter, 0.5);
  EXPECT_NEAR(lower, Teeth::kOuter, 0.5);
}

// The gap is signed: lips that have passed through each other come apart again.
TEST(BSnake, RepulsionUncrossesLips) {
  ToySnake b;
  b.weights.repulsion = 1;
  for (int h = 3; h <= kPoints / 2 - 3; ++h) b.facing.push_back({h, kPoints - h, {0, 1}, 4});
  Control crossed = ellipse({15, 1});
  for (glm::dvec2& p : crossed) p.y = -p.y;
  const auto p = b.settled(crossed);
  EXPECT_GT(p[kPoints * 3 / 4].y - p[kPoints / 4].y, 3.5);
}

TEST(BSnake, RepulsionIsSilentWhileTheGapIsWide) {
  ToySnake b;
  b.weights.repulsion = 1;
  for (int h = 3; h <= kPoints / 2 - 3; ++h) b.facing.push_back({h, kPoints - h, {0, 1}, 4});
  EXPECT_EQ(b.snake().energy(ellipse({15, 12})), 0);
  EXPECT_GT(b.snake().energy(ellipse({15, 3})), 0);
}

// delta_q = 0.75^q over 15 iterations, three descents: what draws the curve lies out of reach, so that every
// control point makes every step.
TEST(BSnake, StepsFollowThePapersSchedule) {
  ToySnake b;
  b.weights.temporal = 1;
  b.before = circle(10, {1000, -1000});
  const SnakeOutcome out = b.minimise(circle(10));
  double reach = 0;
  for (int q = 0; q < kMostIterations; ++q) reach += std::pow(0.75, q);
  EXPECT_EQ(out.restarts, 2);
  EXPECT_EQ(out.iterations, 3 * kMostIterations);
  for (std::size_t i = 0; i < kControls; ++i) {
    EXPECT_NEAR(out.control[i].x - circle(10)[i].x, 3 * reach, 1e-9);
    EXPECT_NEAR(out.control[i].y - circle(10)[i].y, -3 * reach, 1e-9);
  }
}

TEST(BSnake, StopsWhenTheEnergyRests) {
  ToySnake b;
  const SnakeOutcome out = b.minimise(circle(10));
  EXPECT_EQ(out.iterations, 1);
  EXPECT_EQ(out.restarts, 0);
  EXPECT_EQ(out.control, circle(10));
}

TEST(BSnake, NeedsNoMoreIterationsThanADescentHasWhenNear) {
  ToySnake b;
  b.image = contrast_of([](glm::dvec2 p) { return soft_step(length(p) - 12); });
  b.weights.contrast = 1;
  const SnakeOutcome out = b.minimise(circle(12.5));
  EXPECT_LE(out.iterations, kMostIterations);
  EXPECT_EQ(out.restarts, 0);
}

TEST(BSnake, NeverEndsWithMoreEnergyThanItBeganWith) {
  const Teeth teeth(8.8, 0.1);
  for (double radius = 3; radius < 25; radius += 0.7) {
    const Control start = ellipse({radius * 1.5, radius}, {radius - 10, 3});
    const SnakeOutcome out = teeth.bench.minimise(start);
    EXPECT_LE(out.energy, teeth.bench.snake().energy(start));
    EXPECT_NEAR(out.energy, teeth.bench.snake().energy(out.control), 1e-9);
    EXPECT_LE(out.iterations, 3 * kMostIterations);
  }
}

TEST(BSnake, PinnedEndsStay) {
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

TEST(BSnake, CurvesThatLeaveThePictureAreHarmless) {
  ToySnake b;
  b.image = contrast_of([](glm::dvec2 p) { return soft_step(length(p) - 12); });
  b.weights = {.tension = 0.001, .contrast = 1, .change = 1};
  for (const glm::dvec2 p : b.settled(circle(10, {500, -900})))
    EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
}

}  // namespace
}  // namespace fbs
