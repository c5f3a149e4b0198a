#include "encoder/fit/pattern_samples.h"

#include <gtest/gtest.h>

#include "decoder/head/head_deformation.h"
#include "decoder/head/mouth_interior.h"
#include "tests/unit/encoder/fit/seen_scene.h"

namespace fbs {
namespace {

/// From the samples of the scene's own pattern.
double mean_difference(const PatternSamples& samples, const SeenScene& scene) {
  double sum = 0;
  const std::size_t n = scene.comparison.points.size();
  for (std::size_t k = 0; k < n; ++k)
    sum += std::abs(samples.luma(0, k) - scene.comparison.pattern.luma(0, k));
  return sum / static_cast<double>(n);
}

/// Drawn from one pattern and taken as another: what is at a point of the face stays.
TEST(PatternSamples, FollowTheFaceThroughPoseAndExpression) {
  const SeenScene first(SeenScene::rest(), wave_plane(SeenScene::kWidth, SeenScene::kHeight, 3));
  StateMaker maker(3);
  State other = SeenScene::rest();
  maker.pose(other);
  maker.expression(other);
  const WorkFrame frame = SeenScene::frame_of(first.drawn(other));
  const PatternSamples second(first.comparison.points, toy_geometry(), {frame, other, 1});
  const PatternSamples wrong(first.comparison.points, toy_geometry(), {frame, SeenScene::rest(), 1});
  EXPECT_LT(mean_difference(second, first), 0.5);
  EXPECT_GT(mean_difference(wrong, first), 5);
}

TEST(PatternSamples, KnowWhatThePatternAlreadyShows) {
  StateMaker maker(6);
  State seen = SeenScene::rest();
  maker.mouth(seen);
  const SeenScene scene(seen, wave_plane(SeenScene::kWidth, SeenScene::kHeight, 6));
  const PatternSamples& pattern = scene.comparison.pattern;
  EXPECT_EQ(pattern.mouth_gap(), mouth_gap(toy_geometry(), seen));
  EXPECT_EQ(pattern.index(), 0);
}

/// A drawn picture taken as a pattern: what its state's light added is not in the samples.
TEST(PatternSamples, HaveNoLight) {
  const SeenScene first(SeenScene::rest(), wave_plane(SeenScene::kWidth, SeenScene::kHeight, 5));
  StateMaker maker(5);
  State lit = SeenScene::rest();
  maker.light(lit);
  const WorkFrame frame = SeenScene::frame_of(first.drawn(lit));
  const PatternSamples second(first.comparison.points, toy_geometry(), {frame, lit, 1});
  const PatternSamples wrong(first.comparison.points, toy_geometry(), {frame, SeenScene::rest(), 1});
  EXPECT_LT(mean_difference(second, first), 0.6);
  EXPECT_GT(mean_difference(wrong, first), 3);
}

TEST(PatternSamples, AreNegativeBesideTheFrame) {
  const SeenScene scene(SeenScene::rest(), wave_plane(SeenScene::kWidth, SeenScene::kHeight, 3));
  Picture picture(SeenScene::kWidth, SeenScene::kHeight);
  State away = SeenScene::rest();
  away.pose[kShiftX] += 1000 * 64;
  const PatternSamples none(scene.comparison.points, toy_geometry(), {SeenScene::frame_of(picture), away});
  for (std::size_t k = 0; k < scene.comparison.points.size(); ++k)
    for (int level = 0; level < kFitLevels; ++level) EXPECT_LT(none.luma(level, k), 0);
}

}  // namespace
}  // namespace fbs
