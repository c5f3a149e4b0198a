#include "decoder/raster/row_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

using std::int64_t;

constexpr int kMaxCount = 70;
using Row = std::vector<std::uint8_t>;

/// A number of [low, high].
int64_t between(std::mt19937& random, int64_t low, int64_t high) {
  return low + static_cast<int64_t>(random() % static_cast<std::uint64_t>(high - low + 1));
}

/// From anywhere to anywhere in [low, high] along a run.
LinearRow linear_within(std::mt19937& random, int64_t low, int64_t high, int count) {
  const int64_t first = between(random, low, high), last = between(random, low, high);
  return {first, count > 1 ? (last - first) / (count - 1) : between(random, -(1 << 30), 1 << 30)};
}

Row noise_row(std::mt19937& random) {
  Row row(kMaxCount + 2);
  for (std::uint8_t& s : row) s = static_cast<std::uint8_t>(random());
  return row;
}

TEST(SampleRow, TakesSamplesAndTheirMeans) {
  const Plane texture = noise_plane(9, 5, 1);
  Row out(4);
  const auto at = [](int64_t u, int64_t v, int64_t du) {
    return TextureRow{{u << 16, du << 16}, {v << 16, 0}};
  };
  sample_row_clamped(texture, at(2, 3, 1), out.data(), 4);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(out[i], texture.row(3)[2 + i]);
  sample_row_clamped(texture, at(6, 1, -2), out.data(), 4);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(out[i], texture.row(1)[6 - 2 * i]);
  sample_row_clamped(texture, {{(1 << 16) + (1 << 15), 0}, {2 << 16, 0}}, out.data(), 1);
  EXPECT_EQ(out[0], (texture.row(2)[1] + texture.row(2)[2] + 1) / 2);
}

TEST(SampleRow, RepeatsTheBorder) {
  const Plane texture = noise_plane(9, 5, 2);
  Row out(3);
  const int64_t far = int64_t{1} << 40;
  for (const auto& [u, v] : {std::pair{-far, -far}, {-far, far}, {far, -far}, {far, far}}) {
    sample_row_clamped(texture, {{u, 77}, {v, -5}}, out.data(), 3);
    EXPECT_EQ(out, Row(3, texture.row(v < 0 ? 0 : 4)[u < 0 ? 0 : 8]));
  }
}

// SPEC 10.8, word for word.
TEST(SampleRow, IsTheFormatsFormula) {
  std::mt19937 random(3);
  const Plane t = noise_plane(13, 11, 4);
  for (int i = 0; i < 20000; ++i) {
    const int64_t u = between(random, -(3 << 16), 16 << 16), v = between(random, -(3 << 16), 14 << 16);
    std::uint8_t out = 0;
    sample_row_clamped(t, {{u, 0}, {v, 0}}, &out, 1);
    const int64_t cu = std::clamp<int64_t>(u, 0, 12 << 16), cv = std::clamp<int64_t>(v, 0, 10 << 16);
    const int64_t x = cu >> 16, x1 = std::min<int64_t>(x + 1, 12), p = (cu >> 8) % 256;
    const int64_t y = cv >> 16, y1 = std::min<int64_t>(y + 1, 10), q = (cv >> 8) % 256;
    const auto at = [&](int64_t row, int64_t column) { return int64_t{t.samples[row * 13 + column]}; };
    const int64_t top = at(y, x) * (256 - p) + at(y, x1) * p, bottom = at(y1, x) * (256 - p) + at(y1, x1) * p;
    ASSERT_EQ(out, (top * (256 - q) + bottom * q + (1 << 15)) >> 16) << u << ' ' << v;
  }
}

TEST(SampleRow, UncheckedAgreesWithClamped) {
  std::mt19937 random(5);
  const Plane buffer = noise_plane(90, 60, 6);
  const ConstPlaneView texture(buffer.row(4) + 7, 70, 50, 90);  // a part of a larger plane
  for (int i = 0; i < 20000; ++i) {
    const int count = 1 + static_cast<int>(random() % kMaxCount);
    const TextureRow at{linear_within(random, 0, (69 << 16) - 1, count),
                        linear_within(random, 0, (49 << 16) - 1, count)};
    Row fast = noise_row(random), plain = fast;
    sample_row_inside(texture, at, fast.data() + 1, count);
    sample_row_clamped(texture, at, plain.data() + 1, count);
    ASSERT_EQ(fast, plain) << i << ": nothing but the run is written";
  }
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
    light_row_clamped(&out, {offset, 0}, {gain, 0}, 1);
    const int64_t o = std::clamp(offset, -kMaxLit, kMaxLit) >> 8,
                  g = std::clamp(gain, -kMaxLit, kMaxLit) >> 8;
    ASSERT_EQ(out, std::clamp<int64_t>(
                       ((int64_t{luma} << 12) + o + ((luma - 128) * g >> 6) + (1 << 11)) >> 12, 0, 255));
  }
}

TEST(LightRow, UncheckedAgreesWithClamped) {
  std::mt19937 random(8);
  for (int i = 0; i < 20000; ++i) {
    const int count = 1 + static_cast<int>(random() % kMaxCount);
    // Every other row is one that a face has; the rest reaches the limits.
    const int64_t reach = i % 2 == 0 ? kMaxLit / 64 : kMaxLit;
    const LinearRow offset = linear_within(random, -reach, reach, count),
                    gain = linear_within(random, -reach, reach, count);
    const Row luma = noise_row(random);
    Row fast = luma, plain = luma, chosen = luma;
    light_row_inside(fast.data() + 1, offset, gain, count);
    light_row_clamped(plain.data() + 1, offset, gain, count);
    light_row(chosen.data() + 1, offset, gain, count);
    ASSERT_EQ(fast, plain) << i;
    ASSERT_EQ(chosen, plain) << i;
  }
}

// Offset or gain leaves its limits somewhere along the run: the plain kernel must be chosen.
TEST(LightRow, ChoosesTheClampedKernelBeyondTheLimits) {
  std::mt19937 random(9);
  int beyond = 0;
  for (int i = 0; i < 20000; ++i) {
    const int count = 1 + static_cast<int>(random() % kMaxCount);
    const auto row = [&] { return linear_within(random, -3 * kMaxLit, 3 * kMaxLit, count); };
    const LinearRow offset = row(), gain = row();
    const Row luma = noise_row(random);
    Row plain = luma, chosen = luma;
    light_row_clamped(plain.data() + 1, offset, gain, count);
    light_row(chosen.data() + 1, offset, gain, count);
    ASSERT_EQ(chosen, plain) << i;
    beyond += std::abs(offset.first) > kMaxLit ? 1 : 0;
  }
  EXPECT_GT(beyond, 5000);
}

// SPEC 10.10, word for word.
TEST(MixInteriorRow, IsTheFormatsFormula) {
  std::mt19937 random(10);
  for (int i = 0; i < 5000; ++i) {
    const int count = 1 + static_cast<int>(random() % kMaxCount);
    const LinearRow ramp = linear_within(random, -(300 << 16), 600 << 16, count);
    const std::array<std::uint8_t, kInteriorCount> c = {static_cast<std::uint8_t>(random()),
                                                        static_cast<std::uint8_t>(random()),
                                                        static_cast<std::uint8_t>(random())};
    const auto opacity = static_cast<int>(between(random, 0, 256));
    const Row before = noise_row(random);
    Row out = before;
    mix_interior_row(out.data() + 1, c, opacity, ramp, count);
    for (int k = 0; k < kMaxCount; ++k) {
      const int64_t at = std::clamp<int64_t>(ramp.at(k) >> 16, 0, 256);
      const int64_t colour = at < 128 ? (c[0] * (128 - at) + c[1] * at + 64) >> 7
                                      : (c[1] * (256 - at) + c[2] * (at - 128) + 64) >> 7;
      const int64_t expected = (before[k + 1] * (256 - opacity) + colour * opacity + 128) >> 8;
      ASSERT_EQ(out[k + 1], k < count ? expected : before[k + 1]) << i;
    }
    ASSERT_EQ(out[0], before[0]);
  }
}

}  // namespace
}  // namespace fbs
