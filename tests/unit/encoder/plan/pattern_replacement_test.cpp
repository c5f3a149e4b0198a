#include "encoder/plan/pattern_replacement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace fbs {
namespace {

constexpr double kSamples = 1000;
constexpr int kFirst = 40;
constexpr PatternReplacement::Timing kGroups{6, 6, 30};

PatternSizes sizes_with(double change) {
  PatternSizes out;
  out.set_whole(8000, kFirst);
  for (int i = 0; i < 30; ++i) out.learn(change, kFirst, 6);
  return out;
}

/// A talker that has been watched: errors grow by `growth` with each picture, and a pattern came every 12.
PatternReplacement after_lives(double base, double growth) {
  PatternReplacement out(kSamples);
  for (int life = 0; life < 30; ++life) {
    out.begin(base, kFirst);
    for (int t = 1; t <= 12; ++t) out.add(base + growth * t);
  }
  out.begin(base, kFirst);
  return out;
}

/// Pictures, in groups, until a pattern is bought.
int pictures_until_bought(PatternReplacement replacement, const PatternSizes& sizes, double price,
                          double base, double growth) {
  for (int t = 1; t < 1000; ++t) {
    replacement.add(base + growth * t);
    if (t % 6 != 0) continue;
    const auto choice = replacement.at_price(price, {sizes, 1e9}, kGroups);
    if (choice && replacement.pays(*choice, base + growth * (t - 2.5))) return t;
  }
  return 1000;
}

TEST(PatternReplacement, DearBitsAndLittleMotionDelayAPattern) {
  const PatternSizes sizes = sizes_with(1000);
  const PatternReplacement talker = after_lives(1000, 100);
  const int cheap = pictures_until_bought(talker, sizes, 1, 1000, 100);
  const int dear = pictures_until_bought(talker, sizes, 30, 1000, 100);
  EXPECT_LT(cheap, dear);
  EXPECT_LT(dear, 1000);
  EXPECT_GT(pictures_until_bought(after_lives(1000, 10), sizes, 30, 1000, 10), dear);
}

TEST(PatternReplacement, AStillHeadIsRefinedUntilThatIsWorthLessThanItsBits) {
  // Nothing grows: what a finer pattern gains from now on is all there is.
  PatternSizes sizes = sizes_with(100);
  double base = 50000;
  int quantiser = kFirst, bought = 0;
  PatternReplacement head = after_lives(base, 0);
  for (int group = 0; group < 200; ++group) {
    for (int i = 0; i < 6; ++i) head.add(base);
    const auto choice = head.at_price(100, {sizes, 1e9}, kGroups);
    ASSERT_TRUE(choice);
    if (!head.pays(*choice, base)) continue;
    ASSERT_LT(choice->quantiser, quantiser) << "refinement is monotone";
    sizes.learn(sizes.refinement(choice->quantiser) + 100, choice->quantiser, head.age());
    base *= 0.9;
    quantiser = choice->quantiser;
    head.begin(base, quantiser);
    ++bought;
  }
  EXPECT_GT(bought, 0);
  EXPECT_LT(bought, 20) << "and it ends";
  EXPECT_GT(quantiser, 0);
}

TEST(PatternReplacement, ALivelyHeadGetsTwoPatternsAtOnce) {
  const PatternSizes sizes = sizes_with(1000);
  const auto patterns = [&](double growth) {
    const auto choice = after_lives(1000, growth).at_price(1, {sizes, 1e9}, kGroups);
    EXPECT_TRUE(choice);
    EXPECT_EQ(choice->patterns > 1, choice->interval < kGroups.together);
    return choice->patterns;
  };
  EXPECT_EQ(patterns(10), 1);
  EXPECT_EQ(patterns(3000), 2);
  const auto alone = after_lives(1000, 3000).at_price(1, {sizes, 2000}, kGroups);
  ASSERT_TRUE(alone);
  EXPECT_LE(alone->bits_now, 2000) << "all that is sent at once counts";
  auto one = kGroups;
  one.two_at_once = false;
  EXPECT_EQ(after_lives(1000, 3000).at_price(1, {sizes, 1e9}, one)->patterns, 1);
}

TEST(PatternReplacement, AHeadThatKeepsStillIsRefinedOnce) {
  const PatternSizes sizes = sizes_with(1000);
  const double base = 50000, price = 100;
  const auto finer_after = [&](int pictures, double growth) {
    PatternReplacement head = after_lives(base, 0);
    for (int t = 0; t < pictures; ++t) head.add(base + growth);
    return head.finer(price, sizes, kGroups.per_second);
  };
  EXPECT_FALSE(finer_after(30, 0)) << "too early to tell";
  EXPECT_FALSE(finer_after(60, base / 2)) << "it moves";
  const auto quantiser = finer_after(60, 0);
  ASSERT_TRUE(quantiser);
  EXPECT_LT(*quantiser, kFirst);
  PatternReplacement refined = after_lives(base, 0);
  refined.begin(base * std::pow(1.045, *quantiser - kFirst), *quantiser);
  for (int t = 0; t < 60; ++t) refined.add(base / 2);
  EXPECT_FALSE(refined.finer(price, sizes, kGroups.per_second));
}

TEST(PatternReplacement, CheaperBitsBuyFinerPatterns) {
  const PatternSizes sizes = sizes_with(1000);
  const PatternReplacement talker = after_lives(20000, 300);
  int before = 64;
  for (const double price : {1000.0, 100.0, 10.0, 1.0}) {
    const auto choice = talker.at_price(price, {sizes, 1e9}, kGroups);
    ASSERT_TRUE(choice);
    EXPECT_LE(choice->quantiser, before);
    before = choice->quantiser;
  }
  EXPECT_LT(before, kFirst);
}

TEST(PatternReplacement, ThePriceOfARateMakesItsPatternsTakeIt) {
  const PatternSizes sizes = sizes_with(1000);
  const PatternReplacement talker = after_lives(20000, 300);
  for (const double bits : {30.0, 100.0, 300.0}) {
    const double price = talker.price_of(bits, {sizes, 1e9}, kGroups);
    const auto choice = talker.at_price(price, {sizes, 1e9}, kGroups);
    ASSERT_TRUE(choice);
    EXPECT_LE(choice->bits, bits);
    EXPECT_GT(choice->bits, 0.6 * bits);
  }
}

TEST(PatternReplacement, NothingIsOfferedThatDoesNotFit) {
  const PatternSizes sizes = sizes_with(1000);
  const PatternReplacement talker = after_lives(20000, 300);
  const auto choice = talker.at_price(1, {sizes, 900}, kGroups);
  ASSERT_TRUE(choice);
  EXPECT_LE(sizes.change(choice->quantiser, 1), 900);
  EXPECT_FALSE(talker.at_price(1, {sizes, 10}, kGroups));
}

TEST(PatternReplacement, PatternsThatHelpPicturesBeforeThemComeMoreOften) {
  const PatternSizes sizes = sizes_with(1000);
  PatternReplacement helped = after_lives(20000, 2000), not_helped = helped;
  for (int i = 0; i < 30; ++i) {
    helped.learn_between(20000, 6);
    not_helped.learn_between(40000, 6);
  }
  const auto often = helped.at_price(300, {sizes, 1e9}, kGroups);
  const auto seldom = not_helped.at_price(300, {sizes, 1e9}, kGroups);
  ASSERT_TRUE(often && seldom);
  EXPECT_LT(often->cost, seldom->cost);
}

TEST(PatternReplacement, ACutIsBoughtAtOnce) {
  const PatternSizes sizes = sizes_with(1000);
  PatternReplacement talker = after_lives(1000, 10);
  for (int i = 0; i < 6; ++i) talker.add(1e7);
  const auto choice = talker.at_price(100, {sizes, 1e9, true}, kGroups);
  ASSERT_TRUE(choice);
  EXPECT_TRUE(talker.pays(*choice, 1e7));
}

}  // namespace
}  // namespace fbs
