#include "encoder/fit/normal_equations.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

TEST(NormalEquations, PriorsPullBackByTheirWeights) {
  NormalEquations normal(2);
  normal.add_prior(0, 3, 0.5);
  normal.add_prior(1, 2, 1);   // at -2
  normal.add_prior(1, -1, 2);  // at +1, four times as uncertain
  const auto x = normal.solve();
  ASSERT_TRUE(x);
  EXPECT_NEAR((*x)(0), -3, 1e-12);
  EXPECT_NEAR((*x)(1), (4 * -2 + 1 * 1) / 5.0, 1e-12);
}

TEST(NormalEquations, UnknownsThatNothingHoldsCannotBeSolvedFor) {
  NormalEquations normal(2);
  normal.add_prior(0, 3, 0.5);
  EXPECT_FALSE(normal.solve());
}

TEST(NormalEquations, TheUpperTriangleStandsForBoth) {
  NormalEquations normal(2);
  normal.left(0, 1) = 7;
  EXPECT_EQ(normal.symmetric()(1, 0), 7);
}

}  // namespace
}  // namespace fbs
