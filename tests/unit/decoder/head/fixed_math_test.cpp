#include "decoder/head/fixed_math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "common/state.h"

namespace fbs {
namespace {

constexpr double kSimilarityRotation = 2 * std::numbers::pi / 65536;

TEST(RoundShift, RoundsToNearestAndHalvesUpwards) {
  EXPECT_EQ(round_shift(5, 2), 1);
  EXPECT_EQ(round_shift(6, 2), 2);
  EXPECT_EQ(round_shift(-6, 2), -1);
  EXPECT_EQ(round_shift(-7, 2), -2);
  EXPECT_EQ(round_shift(1, 1), 1);
  EXPECT_EQ(round_shift(-1, 1), 0);
}

TEST(SineTable, IsTheRoundedSineOfTheFirstQuarter) {
  for (std::size_t i = 0; i < kSineTable.size(); ++i)
    EXPECT_EQ(kSineTable[i], std::lround(std::sin(static_cast<double>(i) * 64 * kSimilarityRotation) *
                                         (1 << kRotationOneLog2)));
}

TEST(Exp2Table, IsTheRoundedPowerOverOneOctave) {
  for (std::size_t i = 0; i < kExp2Table.size(); ++i)
    EXPECT_EQ(kExp2Table[i], std::lround(std::exp2(static_cast<double>(i) / 256) * (1 << kScaleOneLog2)));
}

// Half a unit from the table, half from the interpolation's rounding, 0.08 from the chord.
TEST(Sine, IsWithin1Point1UnitsOfTheSineAtEveryAngle) {
  for (std::int32_t a = 0; a < 65536; ++a) {
    ASSERT_NEAR(sine(a), std::sin(a * kSimilarityRotation) * 16384, 1.1) << a;
    ASSERT_NEAR(cosine(a), std::cos(a * kSimilarityRotation) * 16384, 1.1) << a;
  }
}

TEST(Sine, IsOddAndMirroredAboutTheQuarterTurn) {
  for (std::int32_t a = 0; a < 65536; ++a) {
    ASSERT_EQ(sine(-a), -sine(a)) << a;
    ASSERT_EQ(sine(32768 - a), sine(a)) << a;
    ASSERT_EQ(cosine(-a), cosine(a)) << a;
  }
}

TEST(Sine, RepeatsEveryTurnForAnyAngle) {
  for (std::int32_t a = -70000; a < 70000; a += 7) {
    ASSERT_EQ(sine(a + 5 * 65536), sine(a));
    ASSERT_EQ(cosine(a), sine(a + 16384));
  }
  EXPECT_EQ(sine(std::numeric_limits<std::int32_t>::min()), 0);
  EXPECT_EQ(sine(std::numeric_limits<std::int32_t>::max()), sine(65535));
  EXPECT_EQ(cosine(std::numeric_limits<std::int32_t>::max()), cosine(65535));
}

TEST(Exp2, IsWithin1Point2UnitsOfItsOctave) {
  for (std::int32_t e = 0; e <= kMaxLogScale; ++e)
    ASSERT_NEAR(static_cast<double>(exp2_q16(e)), std::exp2(e / 4096.0) * 65536, 1.2 * std::exp2(e >> 12))
        << e;
}

TEST(Exp2, RisesAndDoublesEveryOctave) {
  for (std::int32_t e = 1; e <= kMaxLogScale; ++e) ASSERT_GE(exp2_q16(e), exp2_q16(e - 1)) << e;
  for (std::int32_t e = 0; e + 4096 <= kMaxLogScale; ++e) ASSERT_EQ(exp2_q16(e + 4096), 2 * exp2_q16(e)) << e;
}

TEST(Exp2, IsClampedOutsideItsRange) {
  EXPECT_EQ(exp2_q16(-1), 65536);
  EXPECT_EQ(exp2_q16(std::numeric_limits<std::int32_t>::min()), 65536);
  EXPECT_EQ(exp2_q16(std::numeric_limits<std::int32_t>::max()), std::int64_t{65536} << 13);
}

// Rounded down: never above, and less than a step below.
TEST(Log2, IsWithinAStepBelow) {
  std::uint64_t x = 1;
  for (int i = 0; i < 4000; ++i, x += 1 + x / 90) {
    const double exact = 4096 * std::log2(static_cast<double>(x));
    ASSERT_LE(log2_fixed(x), exact + 1e-6) << x;
    ASSERT_GT(log2_fixed(x), exact - 1.01) << x;
  }
}

TEST(Log2, IsExactAtPowersOfTwo) {
  for (int n = 0; n < 64; ++n) EXPECT_EQ(log2_fixed(std::uint64_t{1} << n), n * 4096);
  EXPECT_EQ(log2_fixed(~std::uint64_t{0}), 64 * 4096 - 1);
}

}  // namespace
}  // namespace fbs
