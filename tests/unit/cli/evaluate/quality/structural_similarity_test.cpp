#include "cli/evaluate/quality/structural_similarity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

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

Plane noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Plane p(width, height);
  for (auto& s : p.samples) s = static_cast<std::uint8_t>(random());
  return p;
}

/// Wang et al. 2004 as written: an 11 x 11 window of doubles round every sample.
double plain_ssim(const Plane& a, const Plane& b) {
  const auto reflect = [](int i, int n) {
    while (i < 0 || i >= n) i = i < 0 ? -i : 2 * n - 2 - i;
    return i;
  };
  double total = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      double w = 0, ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
      for (int j = -5; j <= 5; ++j) {
        for (int i = -5; i <= 5; ++i) {
          const double g = std::exp(-(i * i + j * j) / (2 * 1.5 * 1.5));
          const double p = a.row(reflect(y + j, a.height))[reflect(x + i, a.width)];
          const double q = b.row(reflect(y + j, b.height))[reflect(x + i, b.width)];
          w += g;
          ma += g * p;
          mb += g * q;
          aa += g * p * p;
          bb += g * q * q;
          ab += g * p * q;
        }
      }
      ma /= w;
      mb /= w;
      const double va = aa / w - ma * ma, vb = bb / w - mb * mb, cov = ab / w - ma * mb;
      constexpr double c1 = 0.01 * 0.01 * 255 * 255, c2 = 0.03 * 0.03 * 255 * 255;
      total += (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
    }
  }
  return total / (a.width * a.height);
}

double ssim_of(const Plane& a, const Plane& b) {
  return structural_similarity(a, b).ssim;
}

TEST(Ssim, IsOneForIdenticalPictures) {
  const Plane p = noise(24, 17, 4);
  EXPECT_NEAR(ssim_of(p, p), 1, 1e-6);
}

TEST(Ssim, OfFlatPicturesIsTheLumaTermAlone) {
  constexpr double c1 = 6.5025;
  EXPECT_NEAR(ssim_of(Plane(20, 20, 100), Plane(20, 20, 120)),
              (2 * 100 * 120 + c1) / (100 * 100 + 120 * 120 + c1), 1e-4);
}

TEST(Ssim, AgreesWithThePlainImplementation) {
  const Plane a = noise(23, 14, 5);
  Plane near_by = a, inverted = a;
  std::mt19937 random(6);
  for (auto& s : near_by.samples)
    s = static_cast<std::uint8_t>(std::abs(s - static_cast<int>(random() % 30)));
  for (auto& s : inverted.samples) s = static_cast<std::uint8_t>(255 - s);
  for (const Plane& b : {near_by, inverted, noise(23, 14, 7)})
    EXPECT_NEAR(ssim_of(a, b), plain_ssim(a, b), 2e-4);
  EXPECT_LT(ssim_of(a, inverted), 0);
}

TEST(Ssim, TakesPicturesSmallerThanItsWindow) {
  const Plane a = noise(3, 2, 8), b = noise(3, 2, 9);
  EXPECT_NEAR(ssim_of(a, b), plain_ssim(a, b), 2e-4);
}

TEST(StructuralSimilarity, OfEqualPlanesIsOne) {
  const Plane p = textured(192, 180);
  EXPECT_NEAR(structural_similarity(p, p).ssim, 1, 1e-6);
  EXPECT_NEAR(structural_similarity(p, p).ms_ssim, 1, 1e-6);
}

TEST(StructuralSimilarity, SsimIsThatOfAPlainImplementation) {
  const Plane a = textured(97, 60), b = distorted(a, 1);
  EXPECT_NEAR(structural_similarity(a, b).ssim, plain_ssim(a, b), 1e-4);
}

// The values come from a plain implementation: numpy, 64 bits, the window summed sample by sample. On akiyo
// at 352x288 libvmaf's float_ms_ssim, whose borders and filter differ, gave 0.9691 and this 0.9704.
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
