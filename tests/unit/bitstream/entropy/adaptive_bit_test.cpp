#include "bitstream/entropy/adaptive_bit.h"

#include <gtest/gtest.h>

#include <vector>

namespace fbs {
namespace {

// SPEC 2.3
TEST(AdaptiveBit, BeginsAtOneHalf) {
  const AdaptiveBit context;
  EXPECT_EQ(context.zero(), kProbabilityOne / 2);
  EXPECT_EQ(context.experience(), 0);
}

TEST(AdaptiveBit, FirstBitsMoveItTheMost) {
  AdaptiveBit context;
  context.update(false);
  const std::uint32_t first = context.zero();
  EXPECT_EQ(first, 32768u + 2 * 32767 / 3);
  context.update(false);
  EXPECT_GT(context.zero(), first);
  EXPECT_LT(context.zero() - first, first - 32768u);
}

// SPEC 2.3: quotients are truncated, so that the slow estimate stops short of certainty.
TEST(AdaptiveBit, LongRunsEndAtKnownProbabilities) {
  AdaptiveBit zeros, ones;
  for (int i = 0; i < 5000; ++i) {
    zeros.update(false);
    ones.update(true);
  }
  EXPECT_EQ(zeros.zero(), 65460u);
  EXPECT_EQ(ones.zero(), 75u);
}

// SPEC 2.5
TEST(AdaptiveBit, ExperienceHasSixLevels) {
  AdaptiveBit context;
  std::vector<int> first_of_level;
  for (int bits = 0; bits < 300; ++bits, context.update(bits % 2 == 0))
    if (context.experience() == static_cast<int>(first_of_level.size())) first_of_level.push_back(bits);
  EXPECT_EQ(first_of_level, (std::vector{0, 1, 2, 3, 6, 16}));
}

}  // namespace
}  // namespace fbs
