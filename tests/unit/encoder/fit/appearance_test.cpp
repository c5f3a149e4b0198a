#include "encoder/fit/appearance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "decoder/head/head_deformation.h"
#include "decoder/head/mouth_interior.h"
#include "tests/unit/encoder/fit/owner_map.h"
#include "tests/unit/encoder/fit/seen_scene.h"

namespace fbs {
namespace {

using Change = void (StateMaker::*)(State&);

/// Differences between the fit's model of the decoder and the decoder's picture, grey levels.
struct Differences {
  std::vector<double> clear;  ///< at points well inside what is seen, ascending
  std::vector<double> mouth;  ///< the same in the mouth interior, not sorted
  std::vector<double> other;  ///< at folded or hidden triangles and at their edges

  [[nodiscard]] double mean() const { return mean_of(clear); }
  [[nodiscard]] double mean_in_mouth() const { return mean_of(mouth); }
  static double mean_of(const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
  }
  /// All but this share of the differences is smaller.
  [[nodiscard]] double all_but(double share) const {
    return clear[static_cast<std::size_t>(static_cast<double>(clear.size()) * (1 - share))];
  }
  [[nodiscard]] double share_of_others() const {
    return static_cast<double>(other.size()) /
           static_cast<double>(clear.size() + mouth.size() + other.size());
  }
};

void compare(const SeenScene& scene, const State& now, Differences& out) {
  constexpr double kMinArea = 4;  // square pixels: smaller triangles share most samples with others
  const Fit fit = fit_of(now);
  const PlacedHead head(toy_geometry(), fit);
  const Appearance shown = scene.comparison.appearance(fit, head.vertices);
  const OwnerMap owners(scene.scene.geometry->screen_mesh(now));
  for (std::size_t k = 0; k < scene.comparison.points.size(); ++k) {
    const SurfacePoint& p = scene.comparison.points[k];
    Sample drawn;
    ASSERT_TRUE(scene.comparison.picture.sample(0, head(p), drawn));
    const double difference = std::abs(shown.at(k, 0) - drawn.value);
    const bool clear = head.visible_area(p.corner) > kMinArea && owners.shows(p.triangle, head(p));
    const bool mouth = scene.comparison.points.mouth_ramp(k) >= 0;
    (!clear ? out.other : mouth ? out.mouth : out.clear).push_back(difference);
  }
}

/// Over random states that differ from rest by `changes`, with patterns seen at rest or in another such
/// state.
Differences differences(bool seen_at_rest, std::initializer_list<Change> changes) {
  constexpr unsigned kStates = 12;
  Differences out;
  for (unsigned seed = 1; seed <= kStates; ++seed) {
    StateMaker maker(seed);
    const auto any = [&] {
      State state = SeenScene::rest();
      for (const Change change : changes) (maker.*change)(state);
      return state;
    };
    SeenScene scene(seen_at_rest ? SeenScene::rest() : any(),
                    wave_plane(SeenScene::kWidth, SeenScene::kHeight, seed));
    const State now = any();
    scene.set_picture(scene.drawn(now));
    compare(scene, now, out);
  }
  std::ranges::sort(out.clear);
  return out;
}

struct SeenState {
  const char* name;
  bool rest;
};
class AppearanceOf : public testing::TestWithParam<SeenState> {
 protected:
  /// @param hundredth  all but this share is smaller. A thousandth lies along silhouettes, which the decoder
  /// softens and the model does not, or at folds
  static void expect(const Differences& d, double mean, double hundredth) {
    EXPECT_LT(d.mean(), mean);
    EXPECT_LT(d.all_but(0.01), hundredth);
    EXPECT_LT(d.all_but(0.001), 9);
    EXPECT_LT(d.share_of_others(), 0.08);
  }
};
INSTANTIATE_TEST_SUITE_P(Pattern, AppearanceOf,
                         testing::Values(SeenState{"SeenAtRest", true}, SeenState{"SeenInAnyState", false}),
                         [](const auto& test) { return test.param.name; });

// Rounding to whole levels makes a mean of 0.25 less what lies between equal samples. The decoder rounds in
// the atlas and once more in the picture; with light it rounds in each of them again.
TEST_P(AppearanceOf, FollowsPoseAndExpressionAsTheDecoderDraws) {
  expect(differences(GetParam().rest, {&StateMaker::pose, &StateMaker::expression, &StateMaker::gaze}), 0.24,
         0.78);
}

TEST_P(AppearanceOf, FollowsLightAsTheDecoderDraws) {
  expect(differences(GetParam().rest, {&StateMaker::pose, &StateMaker::light}), 0.31, 1);
}

TEST_P(AppearanceOf, ShowsTheMouthInteriorAsTheDecoderDraws) {
  expect(differences(GetParam().rest, {&StateMaker::pose, &StateMaker::mouth}), 0.25, 0.85);
}

TEST_P(AppearanceOf, FollowsLidsAsTheDecoderDraws) {
  expect(differences(GetParam().rest, {&StateMaker::pose, &StateMaker::lids, &StateMaker::gaze}), 0.24, 0.8);
}

TEST_P(AppearanceOf, FollowsAllTogetherAsTheDecoderDraws) {
  expect(differences(GetParam().rest, {&StateMaker::pose, &StateMaker::expression, &StateMaker::gaze,
                                       &StateMaker::lids, &StateMaker::light, &StateMaker::mouth}),
         0.32, 1.1);
}

// The decoder's mouth is round, and fades within a luma sample where it is narrow; the model's has corners.
TEST_P(AppearanceOf, MouthInteriorIsNearlyTheDecoders) {
  EXPECT_LT(differences(GetParam().rest, {&StateMaker::pose, &StateMaker::mouth}).mean_in_mouth(), 6);
}

// Light, mouth and expression already in a pattern are not added again.
TEST(Appearance, IsThePatternInTheStateThatThePatternWasSeenIn) {
  StateMaker maker(5);
  State seen = SeenScene::rest();
  for (const Change change :
       {&StateMaker::pose, &StateMaker::expression, &StateMaker::light, &StateMaker::mouth})
    (maker.*change)(seen);
  SeenScene scene(seen, wave_plane(SeenScene::kWidth, SeenScene::kHeight, 5));
  scene.set_picture(scene.scene.patterns[0].picture);
  const PlacedHead head(toy_geometry(), fit_of(seen));
  const Appearance shown = scene.comparison.appearance(fit_of(seen), head.vertices);
  for (std::size_t k = 0; k < scene.comparison.points.size(); ++k)
    for (int level = 0; level < kFitLevels; ++level) {
      Sample seen_there;
      ASSERT_TRUE(scene.comparison.picture.sample(level, head(scene.comparison.points[k]), seen_there));
      EXPECT_NEAR(shown.at(k, level), seen_there.value, 1e-3) << k;
      EXPECT_EQ(shown.interior_share(k), 0) << k;
    }
}

TEST(Appearance, BasisIsWhatOneLevelOfEachNumberAdds) {
  const SeenScene scene(SeenScene::rest(), wave_plane(SeenScene::kWidth, SeenScene::kHeight, 2));
  StateMaker maker(2);
  State open = SeenScene::rest();
  maker.mouth(open);
  Fit fit = fit_of(open);
  const HeadVertices vertices = skinned(toy_geometry(), fit.offsets);
  const Appearance before = scene.comparison.appearance(fit, vertices);
  const auto added = [&](double& number, std::size_t k) {
    number += 1;
    const double difference = scene.comparison.appearance(fit, vertices).at(k, 0) - before.at(k, 0);
    number -= 1;
    return difference;
  };
  for (std::size_t k = 0; k < scene.comparison.points.size(); k += 7) {
    const double interior = before.interior_share(k);
    const auto light = light_basis(scene.comparison.points.light(k),
                                   static_cast<double>(scene.comparison.pattern.luma(0, k)));
    for (std::size_t i = 0; i < kLightCount; ++i)
      EXPECT_NEAR(added(fit.light[i], k), light[i] * (1 - interior), 1e-9) << k << ' ' << i;
    const auto levels = interior_basis(scene.comparison.points.mouth_ramp(k));
    for (std::size_t i = 0; i < kInteriorCount; ++i)
      EXPECT_NEAR(added(fit.interior[i], k), levels[i] * interior, 1e-9) << k << ' ' << i;
  }
}

TEST(Appearance, InteriorBasisSharesOutOneLevel) {
  for (const double ramp : {0.0, 0.2, 0.5, 0.7, 1.0}) {
    const auto shares = interior_basis(ramp);
    EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0), 1, 1e-12) << ramp;
  }
  EXPECT_EQ(interior_basis(0)[kInteriorUpper], 1);
  EXPECT_EQ(interior_basis(0.5)[kInteriorMiddle], 1);
  EXPECT_EQ(interior_basis(1)[kInteriorLower], 1);
}

}  // namespace
}  // namespace fbs
