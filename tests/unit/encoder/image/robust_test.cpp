#include "encoder/image/robust.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

TEST(Robust, GemanMcClureIsTheSquareNearZeroAndBounded) {
  EXPECT_EQ(geman_mcclure(0.0, 256.0), 0);
  EXPECT_NEAR(geman_mcclure(1.0, 256.0), 1, 0.01);
  EXPECT_LT(geman_mcclure(1e9, 256.0), 256);
  EXPECT_GT(geman_mcclure(1e9, 256.0), 255.9);
}

TEST(Robust, GemanMcClureWeightIsTheSlopeOfTheCost) {
  const double sigma2 = 9, step = 1e-4;
  for (const double squared : {0.01, 1.0, 9.0, 50.0}) {
    const double slope =
        (geman_mcclure(squared + step, sigma2) - geman_mcclure(squared - step, sigma2)) / (2 * step);
    EXPECT_NEAR(geman_mcclure_weight(squared / sigma2), slope, 1e-6) << squared;
  }
}

TEST(Robust, WeightsAreOneAtZeroAndCauchysFallsSlower) {
  EXPECT_EQ(geman_mcclure_weight(0.0F), 1);
  EXPECT_EQ(cauchy_weight(0.0F), 1);
  EXPECT_EQ(cauchy_weight(3.0), 0.25);
  EXPECT_EQ(geman_mcclure_weight(3.0), 0.0625);
  EXPECT_EQ(geman_mcclure_divisor(3.0), 16);
}

}  // namespace
}  // namespace fbs
