#include "common/bspline.h"

#include <gtest/gtest.h>

#include <numeric>

namespace fbs {
namespace {

double sum(const std::array<double, 4>& v) {
  return std::accumulate(v.begin(), v.end(), 0.0);
}

/// What control point i contributes at s.
double weight_of(const SplineBasis& b, int i) {
  double w = 0;
  for (std::size_t k = 0; k < 4; ++k)
    if (b.control[k] == i) w += b.value[k];
  return w;
}

TEST(Bspline, ClosedBasisIsAPartitionOfUnity) {
  for (double s = -12; s < 30; s += 0.037) {
    const SplineBasis b = closed_basis(10, s);
    ASSERT_NEAR(sum(b.value), 1, 1e-12);
    ASSERT_NEAR(sum(b.d1), 0, 1e-12);
    ASSERT_NEAR(sum(b.d2), 0, 1e-12);
    for (const double v : b.value) ASSERT_GE(v, 0);
    for (const int c : b.control) ASSERT_TRUE(c >= 0 && c < 10);
  }
}

TEST(Bspline, ClampedBasisIsAPartitionOfUnity) {
  for (double s = 0; s <= 1; s += 1.0 / 64) {
    const SplineBasis b = clamped_basis(true, s);
    ASSERT_NEAR(sum(b.value), 1, 1e-12);
    ASSERT_NEAR(sum(b.d1), 0, 1e-12);
    ASSERT_NEAR(sum(b.d2), 0, 1e-12);
  }
}

TEST(Bspline, ClosedBasisHasThePeriodOfItsCount) {
  for (const int count : {8, 10}) {
    for (double s = 0; s < count; s += 0.25) {
      for (const double turn : {-3.0, -1.0, 1.0, 2.0}) {
        const SplineBasis a = closed_basis(count, s), b = closed_basis(count, s + turn * count);
        ASSERT_EQ(a.control, b.control) << s;
        for (std::size_t k = 0; k < 4; ++k) ASSERT_NEAR(a.value[k], b.value[k], 1e-12);
      }
    }
  }
}

TEST(Bspline, ClosedBasisIsCentredOnItsIndex) {
  for (int i = 0; i < 10; ++i) {
    EXPECT_NEAR(weight_of(closed_basis(10, i), i), 4.0 / 6, 1e-12);
    EXPECT_NEAR(weight_of(closed_basis(10, i + 0.7), i), weight_of(closed_basis(10, i - 0.7), i), 1e-12);
    EXPECT_NEAR(weight_of(closed_basis(10, i + 2), i), 0, 1e-12);
  }
}

// -1e-17 wraps to exactly `count` in floating point.
TEST(Bspline, ClosedBasisTakesParametersAHairBelowZero) {
  const SplineBasis b = closed_basis(8, -1e-17);
  EXPECT_EQ(b.control, closed_basis(8, 0).control);
}

/// The curve's x when control point i lies at position[i].
double curve(const SplineBasis& b, const std::array<double, 4>& weight,
             const std::array<double, 10>& position) {
  double x = 0;
  for (std::size_t k = 0; k < 4; ++k) x += weight[k] * position[b.control[k]];
  return x;
}

constexpr std::array<double, 10> kPositions = {3, -1, 4, 1, -5, 9, -2, 6, 5, -3};

TEST(Bspline, DerivativesAreThoseByDifference) {
  constexpr double h = 1e-4;
  for (double s = 0.013; s < 10; s += 0.1) {
    const SplineBasis before = closed_basis(10, s - h), b = closed_basis(10, s),
                      after = closed_basis(10, s + h);
    const double x0 = curve(before, before.value, kPositions), x1 = curve(b, b.value, kPositions),
                 x2 = curve(after, after.value, kPositions);
    ASSERT_NEAR(curve(b, b.d1, kPositions), (x2 - x0) / (2 * h), 1e-5) << s;
    ASSERT_NEAR(curve(b, b.d2, kPositions), (x2 - 2 * x1 + x0) / (h * h), 1e-2) << s;
  }
  for (double s = 0.05; s < 0.95; s += 0.1) {
    const SplineBasis before = clamped_basis(true, s - h), b = clamped_basis(true, s),
                      after = clamped_basis(true, s + h);
    for (std::size_t k = 0; k < 4; ++k) {
      ASSERT_NEAR(b.d1[k], (after.value[k] - before.value[k]) / (2 * h), 1e-6);
      ASSERT_NEAR(b.d2[k], (after.value[k] - 2 * b.value[k] + before.value[k]) / (h * h), 1e-5);
    }
  }
}

TEST(Bspline, ClosedCurveIsSmoothAtItsKnots) {
  for (int knot = 0; knot < 10; ++knot) {
    const SplineBasis left = closed_basis(10, knot - 1e-9), right = closed_basis(10, knot);
    EXPECT_NEAR(curve(left, left.value, kPositions), curve(right, right.value, kPositions), 1e-7);
    EXPECT_NEAR(curve(left, left.d1, kPositions), curve(right, right.d1, kPositions), 1e-7);
    EXPECT_NEAR(curve(left, left.d2, kPositions), curve(right, right.d2, kPositions), 1e-7);
  }
}

TEST(Bspline, ClampedCurveBeginsAndEndsInItsOuterControlPoints) {
  EXPECT_EQ(clamped_basis(true, 0).value, (std::array<double, 4>{1, 0, 0, 0}));
  EXPECT_EQ(clamped_basis(true, 1).value, (std::array<double, 4>{0, 0, 0, 1}));
}

TEST(Bspline, ClampedCurveOfEvenControlPointsIsAStraightLine) {
  for (double s = 0; s <= 1; s += 0.125) {
    const SplineBasis b = clamped_basis(true, s);
    EXPECT_NEAR(b.value[1] / 3 + b.value[2] * 2 / 3 + b.value[3], s, 1e-12);
  }
}

TEST(Bspline, PinnedEndsHaveNoControlPoint) {
  EXPECT_EQ(clamped_basis(false, 0.3).control, (std::array<int, 4>{-1, 0, 1, -1}));
  EXPECT_EQ(clamped_basis(false, 0.3).value, clamped_basis(true, 0.3).value);
}

}  // namespace
}  // namespace fbs
