#include "encoder/plan/rate_control.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace fbs {
namespace {

/// Bytes of a startup that grow with quality as pictures do.
std::size_t usual_startup(int quality) {
  return static_cast<std::size_t>(std::lround(400 * std::exp2(quality / 20.0)));
}

TEST(QualityFor, RisesWithTheRate) {
  int last = 0;
  for (double kbps = 0.2; kbps < 2000; kbps *= 1.2) {
    const int quality = quality_for(kbps, 10, usual_startup);
    EXPECT_GE(quality, last) << kbps;
    EXPECT_LE(quality, 100);
    last = quality;
  }
  EXPECT_EQ(last, 100);
}

TEST(QualityFor, RisesWithTheTimeOverWhichTheStartupIsSpread) {
  int last = 0;
  for (const double seconds : {1.0, 3.0, 10.0, 30.0, 300.0}) {
    const int quality = quality_for(3, seconds, usual_startup);
    EXPECT_GE(quality, last) << seconds;
    last = quality;
  }
  EXPECT_GT(last, quality_for(3, 1, usual_startup));
}

TEST(QualityFor, IsZeroWhenNothingFits) {
  EXPECT_EQ(quality_for(8, 10, [](int) { return std::size_t{20000}; }), 0) << "16 kbit/s of startup alone";
  EXPECT_EQ(quality_for(0.01, 10, [](int) { return std::size_t{0}; }), 0) << "motion alone is too much";
}

TEST(QualityFor, TakesTheHighestWhoseStartupFits) {
  for (const int last : {1, 7, 50, 99, 100}) {
    int calls = 0;
    const auto startup = [&](int quality) {
      ++calls;
      EXPECT_TRUE(quality >= 0 && quality <= 100) << quality;
      return static_cast<std::size_t>(quality <= last ? 100 : 100'000'000);
    };
    EXPECT_EQ(quality_for(1000, 10, startup), last);
    EXPECT_LE(calls, 8) << "each is a coded picture";
  }
}

TEST(RateBudget, BeginsWithAnEvenShare) {
  EXPECT_DOUBLE_EQ(RateBudget(2).allowed(0.5), 1000);
  EXPECT_DOUBLE_EQ(RateBudget(0.3).allowed(2), 600);
}

TEST(RateBudget, NextOnesMakeUpForWhatWasLeftOrTooMuch) {
  RateBudget even(1), frugal(1), greedy(1);
  even.spend(1000, 1);
  frugal.spend(500, 1);
  greedy.spend(1400, 1);
  EXPECT_DOUBLE_EQ(even.allowed(1), 1000);
  EXPECT_GT(frugal.allowed(1), 1000);
  EXPECT_LE(frugal.allowed(1), 1500) << "no more than was left";
  EXPECT_LT(greedy.allowed(1), 1000);
}

TEST(RateBudget, NeverStarvesAGroup) {
  RateBudget budget(1);
  budget.spend(1e6, 1);
  EXPECT_GT(budget.allowed(1), 100);
}

// Groups that cannot be had for just what they may take, of uneven lengths.
TEST(RateBudget, KeepsTheRateOverManyGroups) {
  std::mt19937 random(1);
  for (const double bias : {-0.3, 0.0, 0.3}) {
    RateBudget budget(1.5);
    double bits = 0, seconds = 0;
    for (int g = 0; g < 60; ++g) {
      const double length = 0.5 + random() % 100 / 100.0;
      const double spent = budget.allowed(length) * (1 + bias + random() % 400 / 1000.0 - 0.2);
      budget.spend(spent, length);
      bits += spent;
      seconds += length;
    }
    EXPECT_NEAR(bits / seconds / 1500, 1, 0.05) << bias;
  }
}

/// Bits of a group as it behaves: about a third fewer for twice the lambda.
double usual_bits(double lambda) {
  return 900 * std::pow(lambda, -0.6);
}

TEST(LambdaFor, MeetsTheAllowance) {
  for (double allowed = 60; allowed < 4000; allowed *= 1.7) {
    const double answer = std::pow(900 / allowed, 1 / 0.6);
    for (const double off : {0.1, 0.4, 1.0, 3.0, 12.0}) {
      int calls = 0;
      const double lambda = lambda_for(allowed, answer * off, 1, [&](double at) {
        ++calls;
        return usual_bits(at);
      });
      EXPECT_LE(usual_bits(lambda), allowed) << off;
      EXPECT_GT(usual_bits(lambda), 0.85 * allowed) << off;
      EXPECT_LE(calls, 10) << "each plans a group";
    }
  }
}

TEST(LambdaFor, KeepsALambdaThatIsRight) {
  int calls = 0;
  const double lambda = lambda_for(1000, 5, 2, [&](double) {
    ++calls;
    return 995.0;
  });
  EXPECT_EQ(lambda, 5);
  EXPECT_EQ(calls, 1);
}

TEST(LambdaFor, StaysBoundedByTheRests) {
  for (const double rest : {0.3, 2.0, 40.0}) {
    const double most = lambda_for(1, rest, rest, [](double) { return 1e6; });
    EXPECT_GT(most, 100 * rest) << "it tries";
    EXPECT_LE(most, 4096 * rest);
    const double least = lambda_for(1e6, rest, rest, [](double) { return 1.0; });
    EXPECT_LT(least, rest / 10);
    EXPECT_GE(least, rest / 64);
  }
}

// A group whose bits jump: rather too few than too many.
TEST(LambdaFor, TakesTooFewBitsWhereNoneAreRight) {
  for (const double begin : {0.1, 1.0, 2.9, 3.1, 30.0}) {
    const double lambda = lambda_for(1000, begin, 1, [](double at) { return at < 3 ? 5000.0 : 100.0; });
    EXPECT_GE(lambda, 3) << begin;
    EXPECT_LT(lambda, 30) << "no more than it takes";
  }
}

}  // namespace
}  // namespace fbs
