#include "encoder/fit/fit_priors.h"

#include <gtest/gtest.h>

#include "encoder/fit/fit_tuning.h"

namespace fbs {
namespace {

cv::Mat1d step_of_priors(const Fit& start, const Fit& fit) {
  const FitColumns columns(kAllParts);
  NormalEquations normal(columns.count());
  add_priors(columns, {start}, fit, normal);
  return normal.solve().value();
}

TEST(FitPriors, AStartAtRestStays) {
  EXPECT_LT(cv::norm(step_of_priors({}, {}), cv::NORM_INF), 1e-12);
}

TEST(FitPriors, APoseThatHasLeftTheStartGoesBack) {
  Fit fit;
  fit.pose.yaw = 0.02;
  fit.pose.shift.x = 3;
  const cv::Mat1d x = step_of_priors({}, fit);
  EXPECT_NEAR(x(1), -0.02, 1e-12);
  EXPECT_NEAR(x(3), -3, 1e-12);
}

// Between the start and rest, nearer to the start by the variances.
TEST(FitPriors, LightIsHeldNearTheStartAndARestAfar) {
  Fit start;
  start.light[0] = 20;
  start.interior[1] = 20;
  const cv::Mat1d x = step_of_priors(start, start);
  const auto towards_rest = [](double sigma, double rest) {
    return sigma * sigma / (sigma * sigma + rest * rest);
  };
  EXPECT_NEAR(x(FitColumns::kFirstLight), -20 * towards_rest(kLightSigma, kLightRestSigma), 1e-9);
  EXPECT_NEAR(x(FitColumns::kFirstInterior + 1), -20 * towards_rest(kInteriorSigma, kInteriorRestSigma),
              1e-9);
}

TEST(FitPriors, ExpressionsReturnTowardsRest) {
  for (const FeatureId id : {FeatureId::kMouthOuter, FeatureId::kBrowLeft, FeatureId::kUpperLidRight}) {
    Fit start;
    const auto first = static_cast<std::size_t>(feature(id).first_control);
    for (std::size_t c = first; c < first + feature(id).control_count; ++c) start.offsets[c] = {0, 300};
    const cv::Mat1d x = step_of_priors(start, start);
    double along = 0, length = 0;
    for (std::size_t c = first; c < first + feature(id).control_count; ++c) {
      along += 300 * x(static_cast<int>(kFitOffsets + 2 * c + 1));
      length += 300 * 300;
    }
    EXPECT_LT(along, 0) << feature(id).name;
    EXPECT_GT(along, -length) << feature(id).name;
  }
}

}  // namespace
}  // namespace fbs
