#include "cli/program/progress.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

TEST(Progress, ShowsPercentSpeedAndTimeLeft) {
  EXPECT_EQ(progress_text("encoding", 50, 200, 10, 80), "encoding  25 %  50/200  5.0 pictures/s  30 s left");
  EXPECT_EQ(progress_text("encoding", 50, std::nullopt, 10, 80), "encoding  50  5.0 pictures/s");
  EXPECT_EQ(progress_text("encoding", 250, 200, 10, 80),
            "encoding 100 %  250/250  25.0 pictures/s  0 s left");
  EXPECT_EQ(progress_text("encoding", 50, 200, 10, 12), "encoding  2");
}

}  // namespace
}  // namespace fbs
