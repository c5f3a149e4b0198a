#include "encoder/fit/patch_equations.h"

#include <gtest/gtest.h>

#include <random>

namespace fbs {
namespace {

// Against the sums written out in double precision.
TEST(PatchEquations, AddTheirRowsWhereTheColumnsStand) {
  const FitColumns columns(mask_of(PartId::kBrows));
  const auto first = static_cast<std::uint16_t>(feature(FeatureId::kBrowRight).first_control);
  const std::vector<std::uint16_t> controls = {static_cast<std::uint16_t>(first + 1),
                                               static_cast<std::uint16_t>(first + 5)};
  std::vector<std::size_t> place;
  for (std::size_t i = 0; i < FitColumns::kFirstControl; ++i) place.push_back(i);
  for (const std::uint16_t c : controls)
    for (std::size_t axis = 0; axis < 2; ++axis)
      place.push_back(columns.of(static_cast<std::size_t>(c)) + axis);
  PatchEquations patch;
  patch.begin(controls.size());
  const auto n = static_cast<std::size_t>(columns.count());
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
  NormalEquations normal(columns.count());
  patch.add_to(columns, controls, normal);
  const cv::Mat1d all = normal.symmetric();
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(normal.right(i), right[i], 1e-5) << i;
    for (std::size_t j = 0; j < n; ++j)
      EXPECT_NEAR(all(static_cast<int>(i), static_cast<int>(j)), left[i * n + j], 1e-5) << i << ' ' << j;
  }
}

TEST(PatchEquations, BeginForgetsThePatchBefore) {
  const FitColumns columns(kAllParts);
  PatchEquations patch;
  patch.begin(0);
  std::fill_n(patch.row(), kFitOffsets, 1.0F);
  patch.add(1, 1);
  patch.begin(0);
  NormalEquations normal(columns.count());
  patch.add_to(columns, {}, normal);
  EXPECT_EQ(cv::countNonZero(normal.symmetric()), 0);
}

}  // namespace
}  // namespace fbs
