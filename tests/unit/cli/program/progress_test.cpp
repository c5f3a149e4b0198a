#include "cli/program/progress.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

TEST(Progress, ShowsPercentSpeedAndTimeLeft) {
  EXPECT_EQ(progress_text("encoding", {50, 200, 10}, 80),
            "encoding  25 %  50/200  5.0 pictures/s  30 s left");
  EXPECT_EQ(progress_text("encoding", {50, std::nullopt, 10}, 80), "encoding  50  5.0 pictures/s");
  EXPECT_EQ(progress_text("encoding", {250, 200, 10}, 80),
            "encoding 100 %  250/250  25.0 pictures/s  0 s left");
  EXPECT_EQ(progress_text("encoding", {50, 200, 10}, 12), "encoding  2");
}

TEST(Progress, CountsWhatFollowsTheLastPicture) {
  EXPECT_EQ(progress_text("encoding", {50, 200, 10, 300}, 80),
            "encoding  10 %  50/200  5.0 pictures/s  1:30 left");
  EXPECT_EQ(progress_text("encoding", {200, 200, 10, 300, 200}, 80),
            "encoding  80 %  200/200  20.0 pictures/s  5 s left");
  EXPECT_EQ(progress_text("encoding", {200, 200, 10, 300, 900}, 80),
            "encoding 100 %  200/200  20.0 pictures/s  0 s left");
}

}  // namespace
}  // namespace fbs
