#include "encoder/fit/patch_equations.h"

#include <gtest/gtest.h>

#include <random>

namespace fbs {
namespace {

// Against the sums written out in double precision.
TEST(PatchEquations, AddTheirRowsWhereTheColumnsStand) {
  const std::vector<std::uint16_t> place = {0, 1, 2, 5, 6, 9, 13};
  const std::size_t n = 15;
  PatchEquations patch;
  patch.begin(place.size(), 5);
  std::vector<double> left(n * n), right(n);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> number(-1, 1);
  for (int point = 0; point < 5; ++point) {
    const float weight = 1 + number(random), r = number(random);
    float* row = patch.row();
    for (std::size_t i = 0; i < place.size(); ++i) row[i] = number(random);
    for (std::size_t i = 0; i < place.size(); ++i) {
      right[place[i]] += static_cast<double>(weight * row[i] * r);
      for (std::size_t j = 0; j < place.size(); ++j)
        left[place[i] * n + place[j]] += static_cast<double>(weight * row[i] * row[j]);
    }
    patch.add(weight, r);
  }
  NormalEquations normal(n);
  patch.add_to(place, normal);
  const cv::Mat1d all = normal.symmetric();
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(normal.right(i), right[i], 1e-5) << i;
    for (std::size_t j = 0; j < n; ++j)
      EXPECT_NEAR(all(static_cast<int>(i), static_cast<int>(j)), left[i * n + j], 1e-5) << i << ' ' << j;
  }
}

TEST(PatchEquations, BeginForgetsThePatchBefore) {
  const std::vector<std::uint16_t> columns = {0, 1, 2};
  PatchEquations patch;
  patch.begin(columns.size(), 1);
  std::fill_n(patch.row(), columns.size(), 1.0F);
  patch.add(1, 1);
  patch.begin(columns.size(), 1);
  NormalEquations normal(3);
  patch.add_to(columns, normal);
  EXPECT_EQ(cv::countNonZero(normal.symmetric()), 0);
}

}  // namespace
}  // namespace fbs
