#include "bitstream/entropy/logistic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "bitstream/entropy/adaptive_bit.h"

namespace fbs {
namespace {

TEST(Logistic, CostIsTheLogarithmOfTheProbability) {
  for (std::uint32_t p = 1; p <= kProbabilityOne; ++p) {
    EXPECT_NEAR(cost_of(p) / 65536.0, 16 - std::log2(p), 3e-5);
  }
}

TEST(Logistic, SquashInvertsStretch) {
  for (std::uint32_t p = kMinProbability; p <= kProbabilityOne - kMinProbability; ++p) {
    EXPECT_NEAR(squash(stretch(p)), p, 2) << p;
  }
  EXPECT_EQ(squash(INT32_MAX), kProbabilityOne - kMinProbability);
  EXPECT_EQ(squash(INT32_MIN), kMinProbability);
}

}  // namespace
}  // namespace fbs
