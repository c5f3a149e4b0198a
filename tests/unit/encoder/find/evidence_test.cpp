#include "encoder/find/evidence.h"

#include <gtest/gtest.h>

#include "tests/unit/encoder/find/painted_face.h"

namespace fbs {
namespace {

TEST(Search, KeepsTheUsualPlaceWithoutEvidence) {
  EXPECT_NEAR(search(-1, 1, 0.25, 0.1, [](double) { return 0.0; }), 0.25, 1.0 / 128);
}

TEST(Search, WeighsEvidenceAgainstTheDistance) {
  const auto at_half = [](double strength) {
    return [strength](double p) { return strength * ridge(p - 0.5, 0.05); };
  };
  // Half an eye distance away is five sigmas: 25 units of evidence.
  EXPECT_NEAR(search(-1, 1, 0, 0.1, at_half(40)), 0.5, 0.06);
  EXPECT_LT(search(-1, 1, 0, 0.1, at_half(5)), 0.3);
}

TEST(Search, StaysInItsRange) {
  const auto rising = [](double p) { return 1000 * p; };
  EXPECT_LE(search(-0.2, 0.3, 0, 0.1, rising), 0.3);
  EXPECT_LE(search({0.2, 0.3, 0.1}, 1, rising), 1.3);
}

TEST(MeanOver, IsExactForALine) {
  EXPECT_NEAR(mean_over(2, 0.5, [](double x) { return 3 * x + 1; }), 7, 1e-12);
}

TEST(BorderEvidence, IsAStepOfBrightnessOrColourAndBounded) {
  const auto step = [](double high) { return [high](glm::dvec2 p) { return p.x < 0.8 ? 60.0 : 60 + high; }; };
  const double none = border_evidence(painted_face(step(0)), 0.8, 0.5);
  const double some = border_evidence(painted_face(step(20)), 0.8, 0.5);
  EXPECT_NEAR(none, 0, 0.02);
  EXPECT_NEAR(some, 1, 0.15);
  EXPECT_EQ(border_evidence(painted_face(step(150)), 0.8, 0.5), 2);
  EXPECT_GT(border_evidence(painted_face(step(0), step(12)), 0.8, 0.5), 0.8);
}

}  // namespace
}  // namespace fbs
