#include "tests/talker/talker_options.h"

#include <gtest/gtest.h>

#include <string>

namespace fbs::talker {
namespace {

TEST(TalkerOptions, ReadsAndRefuses) {
  std::string complaint;
  std::string video = "-", fps = "--fps", rate = "30000/1001", motion = "--motion", turns = "turns",
              bad = "waltz";
  char* good[] = {video.data(), fps.data(), rate.data(), motion.data(), turns.data()};
  const auto options = parse_options(good, complaint);
  ASSERT_TRUE(options.has_value()) << complaint;
  EXPECT_EQ(options->settings.frame_rate, (Rational{30000, 1001}));
  EXPECT_EQ(options->settings.motion, Motion::kTurns);
  char* wrong[] = {video.data(), motion.data(), bad.data()};
  EXPECT_FALSE(parse_options(wrong, complaint).has_value());
  EXPECT_FALSE(complaint.empty());
}

}  // namespace
}  // namespace fbs::talker
