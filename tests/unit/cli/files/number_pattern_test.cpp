#include "cli/files/number_pattern.h"

#include <gtest/gtest.h>

#include <optional>

namespace fbs {
namespace {

TEST(NumberPattern, FillsAndReadsNumbers) {
  const auto pattern = parse_number_pattern("frame_%05d.png");
  ASSERT_TRUE(pattern);
  EXPECT_EQ(pattern->name(42), "frame_00042.png");
  EXPECT_EQ(pattern->name(123456), "frame_123456.png");
  EXPECT_EQ(pattern->number("frame_00042.png"), 42);
  EXPECT_EQ(pattern->number("frame_42.png"), std::nullopt);
  EXPECT_EQ(pattern->number("frame_.png"), std::nullopt);
  for (const char* text :
       {"frame.png", "%s.png", "%05d_%05d.png", "%99999d.png", "%0999d", "100%", "%5d.png"}) {
    EXPECT_FALSE(parse_number_pattern(text)) << text;
  }
}

}  // namespace
}  // namespace fbs
