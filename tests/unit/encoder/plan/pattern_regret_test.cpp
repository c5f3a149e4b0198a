#include "encoder/plan/pattern_regret.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fbs {
namespace {

/// Pictures until a pattern pays, when the error grows by `growth` from picture to picture.
int pictures_until_it_pays(double growth, double bits, double lambda, double patience = 1) {
  PatternRegret regret;
  regret.begin(100);
  for (int t = 1;; ++t) {
    regret.add(100 + growth * t);
    if (regret.pays(bits, lambda, patience)) return t;
  }
}

TEST(PatternRegret, PaysOnceItsPriceIsLost) {
  EXPECT_EQ(pictures_until_it_pays(1, 9, 1), 4);  // 1 + 2 + 3 + 4 is more than 9
  EXPECT_EQ(pictures_until_it_pays(1, 10, 1), 5);
  EXPECT_EQ(pictures_until_it_pays(1, 5, 2), 5);
}

TEST(PatternRegret, GrowingErrorsPayAfterTheRootOfThePrice) {
  // The mean of growth * t / 2 + price / t is least at the root of 2 * price / growth.
  for (const double price : {200.0, 800.0, 5000.0}) {
    const double best = std::sqrt(2 * price);
    EXPECT_NEAR(pictures_until_it_pays(1, price, 1, 4), best, 0.25 * best + 1);
  }
  EXPECT_EQ(pictures_until_it_pays(1, 500, 2, 4), pictures_until_it_pays(1, 1000, 1, 4));
}

TEST(PatternRegret, ErrorsThatStayBuyLittle) {
  PatternRegret regret;
  regret.begin(100);
  int pictures = 0;
  for (; !regret.pays(100, 1, 4); ++pictures) regret.add(110);
  EXPECT_GT(pictures, 30);  // 10 would lose the price
  EXPECT_LT(pictures, 100) << "what changes and stays is sent in the end";
}

TEST(PatternRegret, ACutPaysAtOnce) {
  EXPECT_EQ(pictures_until_it_pays(1e6, 1000, 100), 1);
}

TEST(PatternRegret, PicturesAsGoodAsThePatternsOwnCostNothing) {
  PatternRegret regret;
  regret.begin(100);
  for (int t = 0; t < 1000; ++t) regret.add(t % 2 == 0 ? 100 : 90);
  EXPECT_FALSE(regret.pays(1, 1, 1));
}

TEST(PatternRegret, BeginsAnewWithEachPattern) {
  PatternRegret regret;
  regret.begin(0);
  regret.add(50);
  regret.begin(50);
  regret.add(60);
  EXPECT_TRUE(regret.pays(9, 1, 1));
  EXPECT_FALSE(regret.pays(10, 1, 1));
}

}  // namespace
}  // namespace fbs
