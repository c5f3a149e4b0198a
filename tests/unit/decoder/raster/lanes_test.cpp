#include "decoder/raster/lanes.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace fbs {
namespace {

std::vector<std::uint8_t> counting(std::size_t count, int first) {
  std::vector<std::uint8_t> out(count);
  std::iota(out.begin(), out.end(), static_cast<std::uint8_t>(first));
  return out;
}

TEST(Lanes, KeepTheOrderOfSamples) {
  const auto samples = counting(9, 250);  // 250..255, 0, 1, 2
  const Lanes lanes = load_lanes(samples.data() + 1);
  for (int k = 0; k < kLaneCount; ++k) EXPECT_EQ(lanes[k], samples[k + 1]);
  std::vector<std::uint8_t> out(10, 77);
  store_lanes(lanes, out.data() + 1);
  EXPECT_TRUE(std::equal(samples.begin() + 1, samples.end(), out.begin() + 1));
  EXPECT_EQ(out.front(), 77);
  EXPECT_EQ(out.back(), 77);
}

TEST(Lanes, StoreOnlyTheFirst) {
  for (int count = 1; count <= kLaneCount; ++count) {
    std::vector<std::uint8_t> out(kLaneCount, 77);
    store_first_lanes(load_lanes(counting(8, 200).data()), out.data(), count);
    for (int k = 0; k < kLaneCount; ++k) EXPECT_EQ(out[k], k < count ? 200 + k : 77) << count;
  }
}

TEST(Lanes, PairsHaveTheFirstSampleLow) {
  const auto samples = counting(20, 100);
  const Lanes pairs = load_pairs([&](int lane) { return samples.data() + 2 * (7 - lane); });
  for (int k = 0; k < kLaneCount; ++k) {
    EXPECT_EQ(pairs[k] & 255, 100 + 2 * (7 - k));
    EXPECT_EQ(pairs[k] >> 8, 101 + 2 * (7 - k));
  }
}

TEST(Lanes, NarrowingClampsToSamples) {
  const Lanes wide = {0, 1, 254, 255, 100, 101, 102, 103};
  auto halves = widen(wide);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(halves[1][k], 100 + k);
  halves[0] = SignedWideLanes{-1, -1000, 256, 1200};
  const Lanes narrow = narrow_clamped(halves);
  const Lanes expected = {0, 0, 255, 255, 100, 101, 102, 103};
  for (int k = 0; k < kLaneCount; ++k) EXPECT_EQ(narrow[k], expected[k]);
}

TEST(Lanes, MultiplyHighKeepsTheUpperHalves) {
  const Lanes a = {0, 1, 255, 256, 32768, 40000, 65535, 65535}, b = {7, 65535, 257, 256, 2, 50000, 1, 65535};
  const Lanes expected = {0, 0, 0, 1, 1, 30517, 0, 65534};
  const Lanes high = multiply_high(a, b);
  for (int k = 0; k < kLaneCount; ++k) EXPECT_EQ(high[k], expected[k]) << k;
}

TEST(Lanes, MultiplyWideKeepsSigns) {
  const SignedLanes a = {0, 1, -1, 127, -128, 32767, -32768, 100},
                    b = {7, -9, -9, 32767, 32767, -32768, -32768, 5};
  const auto wide = multiply_wide(a, b);
  for (int k = 0; k < kLaneCount; ++k)
    EXPECT_EQ(wide[static_cast<std::size_t>(k / 4)][k % 4], a[k] * b[k]) << k;
}

TEST(Lanes, MultiplesOverflowAsPositionsDo) {
  const Lanes lanes = multiples(-3);
  for (int k = 0; k < kLaneCount; ++k) EXPECT_EQ(lanes[k], static_cast<std::uint16_t>(-3 * k));
  EXPECT_EQ(multiples((std::int64_t{5} << 16) + 1)[7], 7);
}

}  // namespace
}  // namespace fbs
