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
    const int quality = *quality_for(kbps, 10, usual_startup);
    EXPECT_GE(quality, last) << kbps;
    EXPECT_LE(quality, 100);
    last = quality;
  }
  EXPECT_EQ(last, 100);
}

TEST(QualityFor, RisesWithTheTimeOverWhichTheStartupIsSpread) {
  int last = 0;
  for (const double seconds : {1.0, 3.0, 10.0, 30.0, 300.0}) {
    const int quality = *quality_for(3, seconds, usual_startup);
    EXPECT_GE(quality, last) << seconds;
    last = quality;
  }
  EXPECT_GT(last, *quality_for(3, 1, usual_startup));
}

TEST(QualityFor, IsZeroWhenNothingFits) {
  EXPECT_EQ(*quality_for(8, 10, [](int) { return std::size_t{20000}; }), 0) << "16 kbit/s of startup alone";
  EXPECT_EQ(*quality_for(0.01, 10, [](int) { return std::size_t{0}; }), 0) << "motion alone is too much";
}

TEST(QualityFor, TakesTheHighestWhoseStartupFits) {
  for (const int last : {1, 7, 50, 99, 100}) {
    int calls = 0;
    const auto startup = [&](int quality) {
      ++calls;
      EXPECT_TRUE(quality >= 0 && quality <= 100) << quality;
      return static_cast<std::size_t>(quality <= last ? 100 : 100'000'000);
    };
    EXPECT_EQ(*quality_for(1000, 10, startup), last);
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

// Groups of uneven lengths, whose bits cannot match their allowance exactly.
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

TEST(QualityFor, PassesOnTheErrorOfItsStartup) {
  const auto failed =
      quality_for(3, 10, [](int) -> Result<std::size_t> { return fail(ErrorCode::kIo, "full"); });
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::kIo);
}

TEST(PlanRate, FollowsQualityWithoutCodingAnythingWhereNoBitrateIsSet) {
  const auto plan = plan_rate({.quality = 70, .motion_kbps = 0.6, .eye_distance_px = 40}, 500,
                              [](int) -> Result<std::size_t> { return fail(ErrorCode::kInternal, "coded"); });
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->point.pattern_quantiser, OperatingPoint::at(70, 40).pattern_quantiser);
  EXPECT_EQ(plan->motion_kbps, 0.6);
}

TEST(PlanRate, LeavesMotionWhatTheStartupDoesNotTake) {
  const RateTarget target{.bitrate_kbps = 4, .seconds = 10, .eye_distance_px = 40};
  const auto plan = plan_rate(target, 500, [](int quantiser) -> Result<std::size_t> {
    return std::size_t{4000} - 50 * static_cast<std::size_t>(quantiser);
  });
  ASSERT_TRUE(plan);
  const double startup_kbps = 8e-3 * (500 + 4000 - 50 * plan->point.pattern_quantiser) / 10;
  EXPECT_NEAR(plan->motion_kbps, 4 - startup_kbps, 1e-9);
}

TEST(PlanRate, NeverStarvesMotion) {
  const auto plan = plan_rate({.bitrate_kbps = 2, .seconds = 2, .eye_distance_px = 40}, 500,
                              [](int) -> Result<std::size_t> { return std::size_t{9000}; });
  ASSERT_TRUE(plan);
  EXPECT_NEAR(plan->motion_kbps, 0.15 * 2, 1e-9);
}

/// A planned group as seen by the search.
struct Trial {
  double lambda, bits;
};

/// Bits of a group as it behaves: about a third fewer for twice the lambda.
double usual_bits(double lambda) {
  return 900 * std::pow(lambda, -0.6);
}

TEST(PlanWithin, MeetsTheAllowance) {
  for (double allowed = 60; allowed < 4000; allowed *= 1.7) {
    const double answer = std::pow(900 / allowed, 1 / 0.6);
    for (const double off : {0.1, 0.4, 1.0, 3.0, 12.0}) {
      int calls = 0;
      const Trial found = plan_within(allowed, answer * off, 1.0, [&](double at) {
        ++calls;
        return Trial{at, usual_bits(at)};
      });
      EXPECT_EQ(found.bits, usual_bits(found.lambda)) << "what is returned was planned at its lambda";
      EXPECT_LE(found.bits, allowed) << off;
      EXPECT_GT(found.bits, 0.85 * allowed) << off;
      EXPECT_LE(calls, 10) << "each plans a group";
    }
  }
}

TEST(PlanWithin, KeepsALambdaThatIsRight) {
  int calls = 0;
  const Trial found = plan_within(1000, 5.0, 2.0, [&](double at) {
    ++calls;
    return Trial{at, 995};
  });
  EXPECT_EQ(found.lambda, 5);
  EXPECT_EQ(calls, 1);
}

TEST(PlanWithin, StaysBoundedByTheBase) {
  for (const double base : {0.3, 2.0, 40.0}) {
    const double most = plan_within(1, base, base, [](double at) { return Trial{at, 1e6}; }).lambda;
    EXPECT_GT(most, 100 * base) << "it tries";
    EXPECT_LE(most, 4096 * base);
    const double least = plan_within(1e6, base, base, [](double at) { return Trial{at, 1.0}; }).lambda;
    EXPECT_LT(least, base / 10);
    EXPECT_GE(least, base / 64);
  }
}

// A group whose bits jump: too few rather than too many.
TEST(PlanWithin, TakesTooFewBitsWhereNoneAreRight) {
  for (const double begin : {0.1, 1.0, 2.9, 3.1, 30.0}) {
    const Trial found = plan_within(1000, begin, 1.0, [](double at) {
      return Trial{at, at < 3 ? 5000.0 : 100.0};
    });
    EXPECT_GE(found.lambda, 3) << begin;
    EXPECT_LT(found.lambda, 30) << "no more than it takes";
    EXPECT_EQ(found.bits, 100);
  }
}

}  // namespace
}  // namespace fbs
