#include "encoder/landmarks/shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace fbs {
namespace {

Shape random_shape(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(50, 20);
  Shape out;
  for (glm::vec2& p : out) p = {normal(random), normal(random)};
  return out;
}

TEST(Shape, SimilarityBetweenShapesIsTheOneThatMadeThem) {
  const Shape from = random_shape(1);
  const PlaneSimilarity made{std::polar(1.7F, 0.6F), {12, -5}};
  const PlaneSimilarity found = PlaneSimilarity::between(from, made(from));
  EXPECT_NEAR(std::abs(found.turn - made.turn), 0, 1e-4);
  EXPECT_NEAR(std::abs(found.shift - made.shift), 0, 1e-2);
}

TEST(Shape, InverseLeadsBack) {
  const PlaneSimilarity there{std::polar(0.4F, -1.1F), {3, 40}};
  const glm::vec2 p(7, -9), back = there.inverse()(there(p));
  EXPECT_NEAR(back.x, p.x, 1e-3);
  EXPECT_NEAR(back.y, p.y, 1e-3);
}

TEST(Shape, OfOnePointHasASimilarityAllTheSame) {
  const PlaneSimilarity s = PlaneSimilarity::between(Shape{}, random_shape(2));
  EXPECT_TRUE(std::isfinite(s.shift.real()));
  EXPECT_EQ(s.turn, std::complex<float>(1));
}

TEST(Shape, MirroredLandmarksArePairs) {
  for (int k = 0; k < kLandmarkCount; ++k) EXPECT_EQ(mirrored_landmark(mirrored_landmark(k)), k);
  EXPECT_EQ(mirrored_landmark(0), 16) << "jaw";
  EXPECT_EQ(mirrored_landmark(36), 45) << "outer corners of the eyes";
  EXPECT_EQ(mirrored_landmark(48), 54) << "corners of the mouth";
  EXPECT_EQ(mirrored_landmark(30), 30) << "tip of the nose";
}

TEST(Shape, EyeDistanceIsBetweenTheEyesMiddles) {
  Shape shape{};
  for (std::size_t k = 42; k < 48; ++k) shape[k] = {3, 4};
  EXPECT_FLOAT_EQ(eye_distance(shape), 5);
}

}  // namespace
}  // namespace fbs
