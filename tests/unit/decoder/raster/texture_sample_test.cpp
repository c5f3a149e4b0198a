#include "decoder/raster/texture_sample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

using std::int64_t;

/// A number of [low, high].
int64_t between(std::mt19937& random, int64_t low, int64_t high) {
  return low + static_cast<int64_t>(random() % static_cast<std::uint64_t>(high - low + 1));
}

TEST(TextureSample, TakesSamplesAndTheirMeans) {
  const Plane texture = noise_plane(9, 5, 1);
  EXPECT_EQ(texture_sample(texture, 2 << 16, 3 << 16), texture.row(3)[2]);
  EXPECT_EQ(texture_sample(texture, (1 << 16) + (1 << 15), 2 << 16),
            (texture.row(2)[1] + texture.row(2)[2] + 1) / 2);
}

TEST(TextureSample, RepeatsTheBorder) {
  const Plane texture = noise_plane(9, 5, 2);
  const int64_t far = int64_t{1} << 40;
  for (const auto& [u, v] : {std::pair{-far, -far}, {-far, far}, {far, -far}, {far, far}})
    EXPECT_EQ(texture_sample(texture, u, v), texture.row(v < 0 ? 0 : 4)[u < 0 ? 0 : 8]);
}

// SPEC 10.8, word for word.
TEST(TextureSample, IsTheFormatsFormula) {
  std::mt19937 random(3);
  const Plane t = noise_plane(13, 11, 4);
  for (int i = 0; i < 20000; ++i) {
    const int64_t u = between(random, -(3 << 16), 16 << 16), v = between(random, -(3 << 16), 14 << 16);
    const int64_t cu = std::clamp<int64_t>(u, 0, 12 << 16), cv = std::clamp<int64_t>(v, 0, 10 << 16);
    const int64_t x = cu >> 16, x1 = std::min<int64_t>(x + 1, 12), p = (cu >> 8) % 256;
    const int64_t y = cv >> 16, y1 = std::min<int64_t>(y + 1, 10), q = (cv >> 8) % 256;
    const auto at = [&](int64_t row, int64_t column) { return int64_t{t.samples[row * 13 + column]}; };
    const int64_t top = at(y, x) * (256 - p) + at(y, x1) * p, bottom = at(y1, x) * (256 - p) + at(y1, x1) * p;
    ASSERT_EQ(texture_sample(t, u, v), (top * (256 - q) + bottom * q + (1 << 15)) >> 16) << u << ' ' << v;
  }
}

/// A luma and a light, and what of the light SPEC 10.11 computes with.
struct LitSample {
  int luma;
  int64_t offset, gain, o, g;
};
LitSample random_sample(std::mt19937& random) {
  const int64_t most = kMaxSampleLight;
  LitSample out{static_cast<int>(random() % 256), between(random, -2 * most, 2 * most),
                between(random, -2 * most, 2 * most), 0, 0};
  out.o = std::clamp(out.offset, -most, most) >> 8;
  out.g = std::clamp(out.gain, -most, most) >> 8;
  return out;
}

// SPEC 10.11, word for word.
TEST(Lit, IsTheFormatsFormula) {
  std::mt19937 random(7);
  for (int i = 0; i < 20000; ++i) {
    const auto [luma, offset, gain, o, g] = random_sample(random);
    ASSERT_EQ(
        lit(luma, offset, gain),
        std::clamp<int64_t>(((int64_t{luma} << 12) + o + ((luma - 128) * g >> 6) + (1 << 11)) >> 12, 0, 255));
  }
}

TEST(Unlit, IsTheFormatsFormula) {
  std::mt19937 random(9);
  for (int i = 0; i < 20000; ++i) {
    const auto [luma, offset, gain, o, g] = random_sample(random);
    const int64_t d = std::max<int64_t>((1 << 18) + g, 1 << 16);
    const int64_t above = ((int64_t{luma} - 128) << 18) - (o << 6) + d / 2 + (1 << 11) * d;
    ASSERT_GT(above, 0) << "rounded down, not towards zero";
    ASSERT_EQ(unlit(luma, offset, gain), std::clamp<int64_t>(128 + above / d - (1 << 11), 0, 255));
  }
}

// Usual lights, on luma that stays between black and white.
TEST(Unlit, GivesBackWhatWasLit) {
  std::mt19937 random(10);
  for (int i = 0; i < 20000; ++i) {
    const int64_t offset = between(random, -(16 * 30 << 16), 16 * 30 << 16),
                  gain = between(random, -(16 * 20 << 16), 16 * 20 << 16);
    const int luma = static_cast<int>(between(random, 80, 176));
    ASSERT_NEAR(unlit(lit(luma, offset, gain), offset, gain), luma, 1)
        << "a gain below one leaves fewer levels";
  }
}

}  // namespace
}  // namespace fbs
