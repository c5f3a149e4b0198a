#include "encoder/plan/expression_penalty.h"

#include "encoder/model/expression_basis.h"

namespace fbs {
namespace {

/// A control point this far off, head units, costs half a bit. Smaller spends more bits on lips and lids and
/// fewer on the rest; set with the tracks of format 3.
constexpr double kTolerance = 0.03 * kUnitsPerEyeDistance;

}  // namespace

cv::Mat1d expression_penalty(double lambda) {
  const cv::Mat1d even = cv::Mat1d::eye(kCoefficientCount, kCoefficientCount) / (kTolerance * kTolerance);
  cv::Mat1d penalty = cv::Mat1d::zeros(kParameterCount, kParameterCount);
  const cv::Range coefficients(kFirstCoefficient, kParameterCount);
  quadratic_of_coefficients(even).copyTo(penalty(coefficients, coefficients));
  return penalty * lambda / 2;
}

}  // namespace fbs
