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

}  // namespace
}  // namespace fbs
