#include "encoder/plan/expression_penalty.h"

#include <gtest/gtest.h>

#include <utility>

#include "common/generic_head.h"
#include "encoder/model/expression_basis.h"

namespace fbs {
namespace {

constexpr double kLambda = 7;

double penalty_of(const Offsets& offsets) {
  const auto coefficients = to_coefficients(offsets);
  cv::Mat1d x = cv::Mat1d::zeros(kParameterCount, 1);
  for (int k = 0; k < kCoefficientCount; ++k) x(kFirstCoefficient + k) = coefficients[k];
  return cv::Mat1d(x.t() * expression_penalty(kLambda) * x)(0);
}

/// Both lips moved up or down as a whole, head units.
Offsets lips_moved(double upper, double lower) {
  Offsets offsets{};
  for (const auto& [landmark, y] : {std::pair{62, upper}, {66, lower}})
    for (const SkinningWeight& w : skinning_of(vertex_of_landmark(landmark))) offsets[w.control].y = y;
  return offsets;
}

TEST(ExpressionPenalty, IsHalfABitForAControlPointThreeHundredthsOfAnEyeDistanceOff) {
  Offsets offsets{};
  offsets[4].x = 0.03 * kUnitsPerEyeDistance;
  EXPECT_NEAR(penalty_of(offsets), 0.5 * kLambda, 1e-6);
}

TEST(ExpressionPenalty, PartedLipsCostMoreThanLipsMovedTogether) {
  const double d = 0.01 * kUnitsPerEyeDistance;
  EXPECT_GT(penalty_of(lips_moved(0, d)), 1.5 * penalty_of(lips_moved(d, d)));
  EXPECT_NEAR(penalty_of(lips_moved(0, d)), penalty_of(lips_moved(0, -d)), 1e-9)
      << "shut too far or too little";
}

TEST(ExpressionPenalty, IsSilentAboutPoseLightAndSurround) {
  const cv::Mat1d penalty = expression_penalty(1);
  EXPECT_EQ(cv::countNonZero(penalty.rowRange(0, kFirstCoefficient)), 0);
  EXPECT_EQ(cv::countNonZero(penalty.colRange(0, kFirstCoefficient)), 0);
}

}  // namespace
}  // namespace fbs
