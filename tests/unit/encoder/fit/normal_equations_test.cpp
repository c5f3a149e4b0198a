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

TEST(NormalEquations, SolvesToTheLastBitLikeOpenCv) {
  constexpr int kUnknowns = 43;
  cv::RNG random(1);
  cv::Mat1d rows(2 * kUnknowns, kUnknowns), right(kUnknowns, 1), expected;
  random.fill(rows, cv::RNG::UNIFORM, -1, 1);
  random.fill(right, cv::RNG::UNIFORM, -1, 1);
  const cv::Mat1d left = rows.t() * rows;
  NormalEquations normal(kUnknowns);
  for (int i = 0; i < kUnknowns; ++i) {
    normal.right(i) = right(i);
    for (int j = i; j < kUnknowns; ++j) normal.left(i, j) = left(i, j);
  }
  cv::Mat1d whole = left.clone();
  cv::completeSymm(whole);
  ASSERT_TRUE(cv::solve(whole, right, expected, cv::DECOMP_CHOLESKY));
  const auto x = normal.solve();
  ASSERT_TRUE(x);
#ifdef __x86_64__  // others may fuse products and sums
  EXPECT_EQ(cv::norm(*x, expected, cv::NORM_INF), 0);
#else
  EXPECT_LT(cv::norm(*x, expected, cv::NORM_INF), 1e-9);
#endif
}

TEST(NormalEquations, TheUpperTriangleStandsForBoth) {
  NormalEquations normal(2);
  normal.left(0, 1) = 7;
  EXPECT_EQ(normal.symmetric()(1, 0), 7);
}

}  // namespace
}  // namespace fbs
