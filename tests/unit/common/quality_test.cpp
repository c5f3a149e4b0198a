#include "common/quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

namespace fbs {
namespace {

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

TEST(Psnr, HasTheValuesOfTheFormula) {
  EXPECT_NEAR(squared_error(Plane(16, 9, 100), Plane(16, 9, 101)).psnr(), 48.1308, 1e-4);
  EXPECT_NEAR(squared_error(Plane(16, 9, 100), Plane(16, 9, 90)).psnr(), 28.1308, 1e-4);
  EXPECT_NEAR(squared_error(Plane(16, 9, 0), Plane(16, 9, 255)).psnr(), 0, 1e-12);
}

TEST(Psnr, Is99ForIdenticalPicturesAnd0ForNone) {
  const Plane p = noise(20, 20, 1);
  EXPECT_EQ(squared_error(p, p).psnr(), 99);
  EXPECT_EQ(SquaredError{}.psnr(), 0);
}

TEST(Psnr, OfSeveralPicturesIsThatOfTheirMeanError) {
  SquaredError e = squared_error(Plane(8, 8, 0), Plane(8, 8, 2));
  e += squared_error(Plane(8, 8, 5), Plane(8, 8, 5));
  EXPECT_EQ(e.count, 128u);
  EXPECT_NEAR(e.psnr(), 10 * std::log10(255.0 * 255 / 2), 1e-9);
}

TEST(SquaredError, CountsWhereTheMaskIsNotZero) {
  const Plane a = noise(13, 7, 2), b = noise(13, 7, 3);
  Plane mask(13, 7), rest(13, 7);
  for (std::size_t i = 0; i < mask.samples.size(); ++i)
    (i % 3 == 0 ? mask : rest).samples[i] = i % 2 == 0 ? 1 : 255;
  SquaredError parts = squared_error(a, b, mask);
  EXPECT_EQ(parts.count, 31u);
  parts += squared_error(a, b, rest);
  EXPECT_EQ(parts.sum, squared_error(a, b).sum);
  EXPECT_EQ(parts.count, squared_error(a, b).count);
}

TEST(Ssim, IsOneForIdenticalPictures) {
  const Plane p = noise(24, 17, 4);
  EXPECT_NEAR(ssim(p, p), 1, 1e-6);
}

TEST(Ssim, OfFlatPicturesIsTheLumaTermAlone) {
  constexpr double c1 = 6.5025;
  EXPECT_NEAR(ssim(Plane(20, 20, 100), Plane(20, 20, 120)),
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
    EXPECT_NEAR(ssim(a, b), plain_ssim(a, b), 2e-4);
  EXPECT_LT(ssim(a, inverted), 0);
}

TEST(Ssim, TakesPicturesSmallerThanItsWindow) {
  const Plane a = noise(3, 2, 8), b = noise(3, 2, 9);
  EXPECT_NEAR(ssim(a, b), plain_ssim(a, b), 2e-4);
}

}  // namespace
}  // namespace fbs
