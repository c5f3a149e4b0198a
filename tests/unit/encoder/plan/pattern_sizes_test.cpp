#include "encoder/plan/pattern_sizes.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

TEST(PatternSizes, FinerQuantisersTakeMore) {
  PatternSizes sizes;
  sizes.set_whole(8000, 40);
  EXPECT_EQ(sizes.whole(40), 8000);
  EXPECT_GT(sizes.whole(30), 1.5 * sizes.whole(40));
  EXPECT_GT(sizes.change(30, 6), sizes.change(40, 6));
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
