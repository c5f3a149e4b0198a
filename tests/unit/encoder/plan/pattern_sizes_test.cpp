#include "encoder/plan/pattern_sizes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fbs {
namespace {

TEST(PatternSizes, FinerQuantisersTakeMore) {
  PatternSizes sizes;
  sizes.set_whole(8000, 40);
  EXPECT_EQ(sizes.whole(40), 8000);
  EXPECT_GT(sizes.whole(30), 1.5 * sizes.whole(40));
  EXPECT_GT(sizes.change(30, 6), sizes.change(40, 6));
}

TEST(PatternSizes, TrialsTellHowAWholePictureGrows) {
  PatternSizes sizes;
  sizes.set_tried({{63, 250}, {57, 600}, {45, 1400}});
  EXPECT_DOUBLE_EQ(sizes.whole(57), 8 * 600.0);
  EXPECT_NEAR(sizes.whole(60), 8 * std::sqrt(250 * 600.0), 1e-6);
  EXPECT_GT(sizes.whole(44), sizes.whole(45));
  sizes.set_whole(8 * 300.0, 63);
  EXPECT_NEAR(sizes.refinement(57), 8 * (600 * 300.0 / 250 - 300), 1e-6)
      << "all are as much larger as the one sent";
}

TEST(PatternSizes, MoreChangesInALongerTime) {
  PatternSizes sizes;
  sizes.set_whole(8000, 40);
  EXPECT_GT(sizes.change(40, 12), sizes.change(40, 6));
  EXPECT_LT(sizes.change(40, 12), 2 * sizes.change(40, 6));
}

TEST(PatternSizes, OnlyAFinerQuantiserRefines) {
  PatternSizes sizes;
  sizes.set_whole(8000, 40);
  EXPECT_EQ(sizes.refinement(40), 0);
  EXPECT_EQ(sizes.refinement(50), 0);
  EXPECT_EQ(sizes.refinement(34), sizes.whole(34) - 8000);
  sizes.learn(5000, 34, 6);
  EXPECT_EQ(sizes.refinement(34), 0) << "it has been sent";
}

TEST(PatternSizes, ChangeFollowsCodedPatterns) {
  PatternSizes sizes;
  sizes.set_whole(8000, 40);
  for (int i = 0; i < 20; ++i) sizes.learn(1000, 40, 6);
  EXPECT_NEAR(sizes.change(40, 6), 1000, 1);
  for (int i = 0; i < 20; ++i) sizes.learn(300, 46, 6);
  EXPECT_NEAR(sizes.change(46, 6), 300, 1);
}

TEST(PatternSizes, WhatRefinesIsNotTakenForChange) {
  PatternSizes sizes;
  sizes.set_whole(8000, 40);
  for (int i = 0; i < 20; ++i) sizes.learn(500, 40, 6);
  sizes.learn(sizes.refinement(38) + sizes.change(38, 6), 38, 6);
  EXPECT_NEAR(sizes.change(40, 6), 500, 1);
}

}  // namespace
}  // namespace fbs
