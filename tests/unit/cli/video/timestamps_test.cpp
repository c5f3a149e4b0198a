#include "cli/video/timestamps.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

TEST(Timestamps, RegularTimesAreRoundedWithoutDrift) {
  EXPECT_EQ(regular_pts(3, {25, 1}), 10800);
  EXPECT_EQ(regular_pts(1, {24000, 1001}), 3754);  // 3753.75
  EXPECT_EQ(regular_pts(24000LL * 3600, {24000, 1001}), 1001LL * 3600 * kTicksPerSecond);
}

}  // namespace
}  // namespace fbs
