#include "encoder/segment/segment_renderer.h"

#include <gtest/gtest.h>

#include "tests/unit/encoder/blend/blended_scene.h"
#include "tests/unit/encoder/fit/fitted_scene.h"

namespace fbs {
namespace {

State at_picture(State state, std::int32_t picture) {
  state.picture = picture;
  return state;
}

TEST(SegmentRenderer, DrawsEachGroupFromWhatTheDecoderHas) {
  BlendedScene s(3);
  // The third takes the place of the first.
  const SegmentPatterns patterns{s.blend(), {{0}, {0, 1}, {2, 1}}};
  SegmentRenderer renderer(patterns);
  const State state = at_picture(SeenScene::rest(), 13);
  for (std::size_t g = 0; g < patterns.available.size(); ++g) {
    Scene expected = s.scene;
    expected.patterns.clear();
    for (const std::size_t k : patterns.available[g]) expected.patterns.push_back(s.scene.patterns[k]);
    renderer.begin_group(g);
    const auto drawn = renderer.draw(state, {0, 0, BlendedScene::kWidth, BlendedScene::kHeight});
    ASSERT_TRUE(drawn);
    EXPECT_EQ((*drawn)->samples, rendered(expected, state).y.samples) << g;
  }
}

TEST(SegmentRenderer, InteriorOpacityIsWhatThePatternsDoNotShow) {
  BlendedScene s(1);
  const State shut = at_picture(SeenScene::rest(), 5), open = with_open_mouth(shut);
  s.add_pattern(at_picture(open, 10), 2);
  const SegmentPatterns patterns{s.blend(), {{0}, {1}, {0, 1}}};
  SegmentRenderer renderer(patterns);
  const auto opacity = [&](std::size_t group, const State& state) {
    renderer.begin_group(group);
    return renderer.interior_opacity(state);
  };
  EXPECT_EQ(opacity(0, shut), 0);
  EXPECT_EQ(opacity(0, open), 1);
  EXPECT_EQ(opacity(1, open), 0);
  const double half = opacity(2, with_mode(open, BlendMode::kByTime));
  EXPECT_GT(half, 0.3);
  EXPECT_LT(half, 0.7);
}

}  // namespace
}  // namespace fbs
