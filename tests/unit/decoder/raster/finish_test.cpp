#include "decoder/raster/finish.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace fbs {
namespace {

using std::int64_t;

constexpr int kMaxCount = 70;
using Row = std::vector<std::uint8_t>;

/// A number of [low, high].
int64_t between(std::mt19937& random, int64_t low, int64_t high) {
  return low + static_cast<int64_t>(random() % static_cast<std::uint64_t>(high - low + 1));
}

Row noise_row(std::mt19937& random) {
  Row row(kMaxCount + 2);
  for (std::uint8_t& s : row) s = static_cast<std::uint8_t>(random());
  return row;
}

constexpr int64_t kMaxLit = int64_t{kMaxLight} << kLightOneLog2;

// SPEC 10.11, word for word.
TEST(LightRow, IsTheFormatsFormula) {
  std::mt19937 random(7);
  for (int i = 0; i < 20000; ++i) {
    const int64_t offset = between(random, -2 * kMaxLit, 2 * kMaxLit),
                  gain = between(random, -2 * kMaxLit, 2 * kMaxLit);
    const auto luma = static_cast<std::uint8_t>(random());
    std::uint8_t out = luma;
    light_row(&out, {offset, 0}, {gain, 0}, 1);
    const int64_t o = std::clamp(offset, -kMaxLit, kMaxLit) >> 8,
                  g = std::clamp(gain, -kMaxLit, kMaxLit) >> 8;
    ASSERT_EQ(out, std::clamp<int64_t>(
                       ((int64_t{luma} << 12) + o + ((luma - 128) * g >> 6) + (1 << 11)) >> 12, 0, 255));
  }
}

TEST(TakeBackLightRow, IsTheFormatsFormula) {
  std::mt19937 random(9);
  for (int i = 0; i < 20000; ++i) {
    const int64_t offset = between(random, -2 * kMaxLit, 2 * kMaxLit),
                  gain = between(random, -2 * kMaxLit, 2 * kMaxLit);
    const auto luma = static_cast<std::uint8_t>(random());
    std::uint8_t out = luma;
    take_back_light_row(&out, {offset, 0}, {gain, 0}, 1);
    const int64_t o = std::clamp(offset, -kMaxLit, kMaxLit) >> 8,
                  g = std::clamp(gain, -kMaxLit, kMaxLit) >> 8;
    const int64_t d = std::max<int64_t>((1 << 18) + g, 1 << 16);
    const int64_t above = ((int64_t{luma} - 128) << 18) - (o << 6) + d / 2 + (1 << 11) * d;
    ASSERT_GT(above, 0) << "rounded down, not towards zero";
    ASSERT_EQ(out, std::clamp<int64_t>(128 + above / d - (1 << 11), 0, 255));
  }
}

// Usual lights, on luma that stays between black and white.
TEST(TakeBackLightRow, GivesBackWhatWasLit) {
  std::mt19937 random(10);
  for (int i = 0; i < 20000; ++i) {
    const int64_t offset = between(random, -(16 * 30 << 16), 16 * 30 << 16),
                  gain = between(random, -(16 * 20 << 16), 16 * 20 << 16);
    const auto luma = static_cast<std::uint8_t>(between(random, 80, 176));
    std::uint8_t out = luma;
    light_row(&out, {offset, 0}, {gain, 0}, 1);
    take_back_light_row(&out, {offset, 0}, {gain, 0}, 1);
    ASSERT_NEAR(out, luma, 1) << "a gain below one leaves fewer levels";
  }
}

/// A row of a block as a triangle has it: offset and gain linear over the picture.
struct LitBlock {
  TriangleSetup setup{{{{{0, 0}}, {{64 * 64, 0}}, {{0, 64 * 64}}}}, PlaneScale::kLuma};
  Light light;
  RowBlock<PlaneScale::kLuma> block;
};

LitBlock random_lit_block(std::mt19937& random, std::int32_t limit) {
  LitBlock out;
  for (auto* corners : {&out.light.offset, &out.light.gain})
    for (std::int32_t& c : *corners) c = static_cast<std::int32_t>(between(random, -limit, limit));
  const int row = static_cast<int>(random() % 64), first = static_cast<int>(random() % 64);
  out.block = {row, first, 1 + static_cast<int>(random() % kLaneCount), out.setup.from_corner(first, row)};
  return out;
}

// Lights of every strength, and those that leave the limits along the block.
TEST(LightPainter, AgreesWithLightRow) {
  std::mt19937 random(8);
  int beyond = 0;
  for (int i = 0; i < 20000; ++i) {
    const LitBlock lit = random_lit_block(random, i % 2 == 0 ? kMaxLight / 32 : 2 * kMaxLight);
    const auto& block = lit.block;
    const Row luma = noise_row(random);
    Row plain = luma, fast(kLaneCount);
    const LinearRow offset = block.along(lit.setup.gradient(lit.light.offset, 0)),
                    gain = block.along(lit.setup.gradient(lit.light.gain, 0));
    light_row(plain.data(), offset, gain, block.count);
    store_lanes(LightPainter(lit.setup, lit.light).paint(block, load_lanes(luma.data())), fast.data());
    ASSERT_TRUE(std::equal(plain.begin(), plain.begin() + block.count, fast.begin())) << i;
    beyond += std::abs(offset.first) > kMaxLit ? 1 : 0;
  }
  EXPECT_GT(beyond, 2000);
}

}  // namespace
}  // namespace fbs
