#include "encoder/plan/pattern_regret.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

/// Pictures until a pattern pays, when the error grows by `growth` from picture to picture.
int pictures_until_it_pays(double growth, double bits, double lambda) {
  PatternRegret regret;
  regret.begin(100);
  for (int t = 1;; ++t) {
    regret.add(100 + growth * t);
    if (regret.pays(bits, lambda)) return t;
  }
}

TEST(PatternRegret, PaysOnceItsPriceIsLost) {
  EXPECT_EQ(pictures_until_it_pays(1, 9, 1), 4);  // 1 + 2 + 3 + 4 is more than 9
  EXPECT_EQ(pictures_until_it_pays(1, 10, 1), 5);
  EXPECT_EQ(pictures_until_it_pays(1, 5, 2), 5);
}

TEST(PatternRegret, ACutPaysAtOnce) {
  EXPECT_EQ(pictures_until_it_pays(1e6, 1000, 100), 1);
}

TEST(PatternRegret, PicturesAsGoodAsThePatternsOwnCostNothing) {
  PatternRegret regret;
  regret.begin(100);
  for (int t = 0; t < 1000; ++t) regret.add(t % 2 == 0 ? 100 : 90);
  EXPECT_FALSE(regret.pays(1, 1));
}

TEST(PatternRegret, BeginsAnewWithEachPattern) {
  PatternRegret regret;
  regret.begin(0);
  regret.add(50);
  regret.begin(50);
  regret.add(60);
  EXPECT_TRUE(regret.pays(9, 1));
  EXPECT_FALSE(regret.pays(10, 1));
}

}  // namespace
}  // namespace fbs
