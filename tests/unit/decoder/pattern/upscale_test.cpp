#include "decoder/pattern/upscale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace fbs {
namespace {

Plane noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Plane p(width, height);
  for (auto& s : p.samples) s = static_cast<std::uint8_t>(random());
  return p;
}

/// One sample as SPEC 4.4 defines it.
int defined(const Plane& reduced, int x, int y) {
  constexpr std::array<int, 6> taps{4, -17, 114, 35, -9, 1};
  const int dx = x % 2 == 1 ? 1 : -1, dy = y % 2 == 1 ? 1 : -1;
  int sum = 0;
  for (int m = 0; m < 6; ++m)
    for (int n = 0; n < 6; ++n)
      sum +=
          taps[m] * taps[n] *
          reduced.row(std::clamp(y / 2 + (m - 2) * dy, 0,
                                 reduced.height - 1))[std::clamp(x / 2 + (n - 2) * dx, 0, reduced.width - 1)];
  return std::clamp((sum + 8192) >> 14, 0, 255);
}

TEST(Upscale, IsAsDefinedForAnySize) {
  for (const auto& [w, h] :
       {std::pair{64, 64}, {65, 66}, {66, 65}, {67, 71}, {1, 1}, {2, 3}, {5, 2}, {9, 9}}) {
    const Plane reduced = noise((w + 1) / 2, (h + 1) / 2, static_cast<unsigned>(w));
    const Plane out = upscaled(reduced, w, h);
    ASSERT_EQ(out.width, w);
    ASSERT_EQ(out.height, h);
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x)
        ASSERT_EQ(out.row(y)[x], defined(reduced, x, y)) << w << 'x' << h << " at " << x << ',' << y;
  }
}

TEST(Upscale, KeepsAConstant) {
  for (const int value : {0, 1, 127, 128, 254, 255})
    EXPECT_EQ(upscaled(Plane(20, 13, static_cast<std::uint8_t>(value)), 39, 26),
              Plane(39, 26, static_cast<std::uint8_t>(value)));
}

// Quarters of a step between samples; the taps' own rounding leaves less than half a level.
TEST(Upscale, KeepsARampAndItsPlace) {
  Plane ramp(40, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 40; ++x) ramp.row(y)[x] = static_cast<std::uint8_t>(20 + 4 * x);
  const Plane out = upscaled(ramp, 80, 8);
  for (int x = 6; x < 74; ++x) EXPECT_NEAR(out.row(5)[x], 20 + 2 * x - 1, 1) << x;
}

TEST(Upscale, IsSymmetric) {
  Plane reduced = noise(17, 12, 5);
  Plane out = upscaled(reduced, 34, 24);
  for (Plane* p : {&reduced, &out})
    for (int y = 0; y < p->height; ++y) std::reverse(p->row(y), p->row(y) + p->width);
  EXPECT_EQ(upscaled(reduced, 34, 24), out);
}

TEST(Upscale, HardEdgesStayInRange) {
  Plane edges(16, 16);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) edges.row(y)[x] = (x / 4 + y / 4) % 2 == 0 ? 0 : 255;
  const Plane out = upscaled(edges, 32, 32);
  EXPECT_EQ(std::ranges::max(out.samples), 255);
  EXPECT_EQ(std::ranges::min(out.samples), 0);
}

TEST(Upscale, TreatsEachPlaneOfAPictureBySize) {
  Picture reduced(33, 34);
  reduced.y = noise(33, 34, 1);
  reduced.u = noise(17, 17, 2);
  reduced.v = noise(17, 17, 3);
  const Picture out = upscaled(reduced, 65, 67);
  EXPECT_EQ(out.y, upscaled(reduced.y, 65, 67));
  EXPECT_EQ(out.u, upscaled(reduced.u, 33, 34));
  EXPECT_EQ(out.v, upscaled(reduced.v, 33, 34));
}

}  // namespace
}  // namespace fbs
