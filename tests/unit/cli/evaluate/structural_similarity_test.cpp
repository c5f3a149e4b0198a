#include "cli/evaluate/structural_similarity.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/quality.h"

namespace fbs::cli {
namespace {

Plane textured(int width, int height) {
  Plane p(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      p.row(y)[x] = static_cast<std::uint8_t>(40 + (x * x + 3 * y * y + x * y) / 37 % 170);
  return p;
}

Plane distorted(const Plane& plane, int strength) {
  Plane p = plane;
  for (int y = 0; y < p.height; ++y) {
    for (int x = 0; x < p.width; ++x) {
      const int error = (x * 5 + y * 3) % 17 - 8 + (x / 16) % 3 * 4;
      p.row(y)[x] = static_cast<std::uint8_t>(std::clamp(p.row(y)[x] + strength * error, 0, 255));
    }
  }
  return p;
}

TEST(StructuralSimilarity, OfEqualPlanesIsOne) {
  const Plane p = textured(192, 180);
  EXPECT_NEAR(structural_similarity(p, p).ssim, 1, 1e-6);
  EXPECT_NEAR(structural_similarity(p, p).ms_ssim, 1, 1e-6);
}

TEST(StructuralSimilarity, SsimIsThatOfTheCommonFloor) {
  const Plane a = textured(97, 60), b = distorted(a, 1);
  EXPECT_NEAR(structural_similarity(a, b).ssim, ssim(a, b), 1e-4);
}

// The values are those of a plain implementation: numpy, 64 bits, the window summed sample by sample. On
// akiyo at 352x288 libvmaf's float_ms_ssim, whose borders and filter differ, gave 0.9691 and this 0.9704.
TEST(StructuralSimilarity, MsSsimIsThatOfAPlainImplementation) {
  const Plane a = textured(192, 180);
  EXPECT_NEAR(structural_similarity(a, distorted(a, 1)).ms_ssim, 0.971487, 1e-5);
  const Plane small = textured(61, 47);
  EXPECT_NEAR(structural_similarity(small, distorted(small, 1)).ms_ssim, 0.978643, 1e-5);
}

TEST(StructuralSimilarity, FallsWithDistortion) {
  const Plane a = textured(192, 180);
  double before = 1;
  for (const int strength : {1, 2, 4, 8}) {
    const double now = structural_similarity(a, distorted(a, strength)).ms_ssim;
    EXPECT_LT(now, before) << strength;
    before = now;
  }
}

TEST(StructuralSimilarity, OfANegativeIsNoNumberBelowZero) {
  const Plane a = textured(64, 64);
  Plane b = a;
  for (std::uint8_t& v : b.samples) v = static_cast<std::uint8_t>(255 - v);
  EXPECT_LT(structural_similarity(a, b).ssim, 0);
  EXPECT_EQ(structural_similarity(a, b).ms_ssim, 0);
}

TEST(StructuralSimilarity, LeavesOutScalesThatTheWindowDoesNotFit) {
  EXPECT_EQ(ms_ssim_scales(352, 288), 5);
  EXPECT_EQ(ms_ssim_scales(176, 176), 5);
  EXPECT_EQ(ms_ssim_scales(176, 144), 4);
  EXPECT_EQ(ms_ssim_scales(500, 22), 2);
  EXPECT_EQ(ms_ssim_scales(500, 5), 1);
}

}  // namespace
}  // namespace fbs::cli
