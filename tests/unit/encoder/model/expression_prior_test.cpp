#include "encoder/model/expression_prior.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fbs {
namespace {

using Offsets = std::array<glm::dvec2, kControlCount>;

constexpr double kUnit = kUnitsPerEyeDistance;

std::size_t first_of(FeatureId id) {
  return feature(id).first_control;
}

std::size_t end_of(FeatureId id) {
  return first_of(id) + feature(id).control_count;
}

Offsets shifted(FeatureId id, glm::dvec2 by) {
  Offsets offsets{};
  for (std::size_t c = first_of(id); c < end_of(id); ++c) offsets[c] = by;
  return offsets;
}

glm::dvec2 mean_over(const Offsets& offsets, FeatureId id) {
  glm::dvec2 sum(0);
  for (std::size_t c = first_of(id); c < end_of(id); ++c) sum += offsets[c];
  return sum / static_cast<double>(end_of(id) - first_of(id));
}

TEST(ExpressionPrior, CoversLipsAndBrows) {
  EXPECT_EQ(first_of(FeatureId::kMouthOuter), 0U);
  EXPECT_EQ(end_of(FeatureId::kBrowLeft), kExpressionControls);
}

TEST(ExpressionPrior, PrecisionIsSymmetricAndPositive) {
  const cv::Mat1d& p = expression_precision();
  ASSERT_EQ(p.rows, 2 * static_cast<int>(kExpressionControls));
  EXPECT_LT(cv::norm(p, p.t(), cv::NORM_INF), 1e-6 * cv::norm(p, cv::NORM_INF));
  cv::Mat values;
  cv::eigen(p, values);
  double least = 0;
  cv::minMaxLoc(values, &least);
  EXPECT_GT(least, 0);
}

TEST(ExpressionPrior, RestStaysRestAndOtherFeaturesStayAsSeen) {
  EXPECT_EQ(most_probable(Offsets{}), Offsets{});
  const Offsets lid = shifted(FeatureId::kUpperLidLeft, {30, 400});
  EXPECT_EQ(most_probable(lid), lid);
}

TEST(ExpressionPrior, BelievesBrowsThatRiseTogether) {
  Offsets raised = shifted(FeatureId::kBrowRight, {0, -0.08 * kUnit});
  for (std::size_t c = first_of(FeatureId::kBrowLeft); c < end_of(FeatureId::kBrowLeft); ++c)
    raised[c] = {0, -0.08 * kUnit};
  const Offsets out = most_probable(raised);
  EXPECT_NEAR(mean_over(out, FeatureId::kBrowRight).y, -0.08 * kUnit, 0.015 * kUnit);
  EXPECT_NEAR(mean_over(out, FeatureId::kBrowLeft).y, -0.08 * kUnit, 0.015 * kUnit);
}

TEST(ExpressionPrior, DoubtsABrowThatGoesAside) {
  const Offsets out = most_probable(shifted(FeatureId::kBrowRight, {0.08 * kUnit, 0}));
  EXPECT_LT(std::abs(mean_over(out, FeatureId::kBrowRight).x), 0.04 * kUnit);
}

// Contrast sees nothing along the line of a closed mouth: in ten minutes the inner lips slid 15 % of the eye
// distance aside.
TEST(ExpressionPrior, InnerLipsDoNotSlideOutOfTheMouth) {
  const Offsets out = most_probable(shifted(FeatureId::kMouthInner, {0.1 * kUnit, 0}));
  EXPECT_LT(std::abs(mean_over(out, FeatureId::kMouthInner).x), 0.05 * kUnit);
}

}  // namespace
}  // namespace fbs
