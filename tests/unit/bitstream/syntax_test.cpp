#include "bitstream/syntax.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

// SPEC 5.5
TEST(NominalDuration, IsRoundedAndBounded) {
  EXPECT_EQ(nominal_duration({30, 1}), 3000u);
  EXPECT_EQ(nominal_duration({30000, 1001}), 3003u);
  EXPECT_EQ(nominal_duration({24000, 1001}), 3754u) << "3753.75";
  EXPECT_EQ(nominal_duration({1, 60}), kMaxDuration);
  EXPECT_EQ(nominal_duration({1, 61}), kMaxDuration);
  EXPECT_EQ(nominal_duration({200000, 1}), 1u);
}

}  // namespace
}  // namespace fbs
