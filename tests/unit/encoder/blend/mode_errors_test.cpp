#include "encoder/blend/mode_errors.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/unit/encoder/blend/blended_scene.h"

namespace fbs {
namespace {

double over_regions(const ModeErrors& errors, BlendMode mode) {
  return std::accumulate(errors.begin(), errors.end(), 0.0, [&](double sum, const auto& region) {
    return sum + region[static_cast<std::size_t>(mode)];
  });
}

State any_state(unsigned seed, int picture) {
  State state = SeenScene::rest();
  StateMaker maker(seed);
  maker.pose(state), maker.expression(state), maker.light(state);
  if (seed % 2 == 0) maker.mouth(state);
  state.picture = picture;
  return state;
}

TEST(BlendErrors, AgreeWithTheRenderer) {
  for (const std::size_t count : {3, 6}) {
    const BlendedScene s(count, static_cast<unsigned>(count));
    const BlendErrors blend(s.blend(), 0);
    // Two that lie elsewhere, and one of a pattern just before and just behind it.
    std::vector<State> states = {any_state(1, 13), any_state(2, 13)};
    for (const int after : {-1, 1}) {
      states.push_back(s.scene.patterns[1].seen);
      states.back().picture += after;
    }
    std::array<int, kBlendModeCount> compared{};
    for (const State& state : states) {
      Picture source(BlendedScene::kWidth, BlendedScene::kHeight);
      source.y = wave_plane(BlendedScene::kWidth, BlendedScene::kHeight, 77);
      const ModeErrors errors = blend.errors(source.y, state, s.all());
      for (int m = 0; m < kBlendModeCount; ++m) {
        const auto mode = static_cast<BlendMode>(m);
        if (over_regions(errors, mode) >= kTorn) continue;
        ++compared[static_cast<std::size_t>(m)];
        const double drawn = squares(rendered(s.scene, with_mode(state, mode)), source);
        EXPECT_NEAR(over_regions(errors, mode) / drawn, 1, 0.04) << count << " patterns, mode " << m;
      }
    }
    for (const BlendMode mode : {BlendMode::kByState, BlendMode::kStillBefore, BlendMode::kStillAfter})
      EXPECT_GT(compared[static_cast<std::size_t>(mode)], 0) << static_cast<int>(mode);
  }
}

TEST(BlendErrors, FaceThatLiesElsewhereIsNotDrawnStill) {
  const BlendedScene s(3);
  State state = s.scene.patterns[1].seen;
  const Plane& source = s.scene.patterns[1].picture.y;
  const BlendErrors blend(s.blend(), 0);
  const auto still = static_cast<std::size_t>(BlendMode::kStillBefore);
  const auto is_torn = [&](Region region) {
    return blend.errors(source, state, s.all())[static_cast<std::size_t>(region)][still] == kTorn;
  };
  EXPECT_FALSE(is_torn(Region::kRightEye));
  state.pose[kShiftX] += 5 * 64;  // a tenth of the eye distance
  EXPECT_TRUE(is_torn(Region::kRightEye));
  EXPECT_TRUE(is_torn(Region::kMouth));
  EXPECT_FALSE(is_torn(Region::kGround));
}

TEST(BlendErrors, ReducedOnesCountSamplesOfTheFullPicture) {
  const BlendedScene s(3);
  const State state = any_state(1, 13);
  const Plane source = wave_plane(BlendedScene::kWidth, BlendedScene::kHeight, 77);
  const ModeErrors full = BlendErrors(s.blend(), 0).errors(source, state, s.all()),
                   half = BlendErrors(s.blend(), 1).errors(source, state, s.all());
  for (int m = 0; m < kBlendModeCount; ++m)
    EXPECT_NEAR(over_regions(half, static_cast<BlendMode>(m)) / over_regions(full, static_cast<BlendMode>(m)),
                1, 0.06)
        << m;
}

TEST(BlendErrors, OnePatternInAllSlotsMakesWarpedModesEqual) {
  BlendedScene s(0);
  for (int k = 0; k < 4; ++k) {
    State seen = SeenScene::rest();
    seen.picture = 10 * k;
    s.add_pattern(seen, 5);
  }
  const Plane source = wave_plane(BlendedScene::kWidth, BlendedScene::kHeight, 77);
  const ModeErrors errors = BlendErrors(s.blend(), 1).errors(source, any_state(2, 13), s.all());
  for (const auto& region : errors) {
    const double warped = region[static_cast<std::size_t>(BlendMode::kByState)];
    EXPECT_NEAR(region[static_cast<std::size_t>(BlendMode::kByTime)], warped, 1e-9 * warped);
    for (int rank = 0; rank < kNearestCount; ++rank)
      EXPECT_NEAR(region[static_cast<std::size_t>(nearest(rank))], warped, 1e-9 * warped);
  }
  EXPECT_GT(over_regions(errors, BlendMode::kByState), 0);
  EXPECT_NE(over_regions(errors, BlendMode::kStillBefore), over_regions(errors, BlendMode::kByState));
}

TEST(BlendErrors, OnlyAvailablePatternsAreUsed) {
  const BlendedScene s(3);
  State state = s.scene.patterns[1].seen;
  const Plane& source = s.scene.patterns[1].picture.y;
  const std::vector<std::size_t> others = {0, 2}, swapped = {2, 1};
  const BlendErrors blend(s.blend(), 0);
  EXPECT_EQ(over_regions(blend.errors(source, state, s.all()), BlendMode::kStillBefore), 0);
  EXPECT_EQ(over_regions(blend.errors(source, state, swapped), BlendMode::kStillBefore), 0);
  EXPECT_GT(over_regions(blend.errors(source, state, others), BlendMode::kStillBefore), 1e6);
}

}  // namespace
}  // namespace fbs
