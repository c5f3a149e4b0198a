#include "encoder/plan/expression_penalty.h"

#include <gtest/gtest.h>

#include "encoder/model/expression_basis.h"

namespace fbs {
namespace {

TEST(ExpressionPenalty, IsHalfABitForAControlPointThreeHundredthsOfAnEyeDistanceOff) {
  constexpr double kLambda = 7;
  Offsets offsets{};
  offsets[4].x = 0.03 * kUnitsPerEyeDistance;
  const auto coefficients = to_coefficients(offsets);
  cv::Mat1d x = cv::Mat1d::zeros(kParameterCount, 1);
  for (int k = 0; k < kCoefficientCount; ++k) x(kFirstCoefficient + k) = coefficients[k];
  EXPECT_NEAR(cv::Mat1d(x.t() * expression_penalty(kLambda) * x)(0), 0.5 * kLambda, 1e-6);
}

TEST(ExpressionPenalty, IsSilentAboutPoseLightAndSurround) {
  const cv::Mat1d penalty = expression_penalty(1);
  EXPECT_EQ(cv::countNonZero(penalty.rowRange(0, kFirstCoefficient)), 0);
  EXPECT_EQ(cv::countNonZero(penalty.colRange(0, kFirstCoefficient)), 0);
}

}  // namespace
}  // namespace fbs
