#include "cli/evaluate/report/chart_ticks.h"

#include <gtest/gtest.h>

namespace fbs::cli {
namespace {

using Ticks = std::vector<double>;

void expect_near(const Ticks& a, const Ticks& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-9);
}

TEST(ChartTicks, LinearOnesAreRound) {
  expect_near(linear_ticks(21.3, 30.8, 5), {22, 24, 26, 28, 30});
  expect_near(linear_ticks(0, 1, 5), {0, 0.2, 0.4, 0.6, 0.8, 1});
  expect_near(linear_ticks(-0.3, 0.3, 4), {-0.2, 0, 0.2});
  expect_near(linear_ticks(0, 12000, 6), {0, 2000, 4000, 6000, 8000, 10000, 12000});
}

TEST(ChartTicks, LogOnesAreOneTwoFive) {
  expect_near(log_ticks(1, 100), {1, 2, 5, 10, 20, 50, 100});
  expect_near(log_ticks(2.4, 21), {5, 10, 20});
}

TEST(ChartTicks, ShortLogAxesHaveMore) {
  expect_near(log_ticks(3.5, 8.5), {4, 5, 6, 7, 8});
  EXPECT_GE(log_ticks(3.1, 3.9).size(), 3U);
}

TEST(ChartTicks, TextHasNoTrailingZeros) {
  EXPECT_EQ(tick_text(0.5), "0.5");
  EXPECT_EQ(tick_text(20), "20");
  EXPECT_EQ(tick_text(12000), "12000");
  EXPECT_EQ(tick_text(-1e-17), "0");
}

}  // namespace
}  // namespace fbs::cli
