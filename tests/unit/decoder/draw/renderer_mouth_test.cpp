// The renderer's pictures of an open mouth.
#include <gtest/gtest.h>

#include <algorithm>

#include "decoder/draw/renderer.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

/// A closed mouth on a face and before a ground of one colour.
Scene even_scene(const MouthInterior& mouth) {
  Picture picture(160, 128);
  picture.y = Plane(160, 128, 230);
  Scene scene = toy_scene(picture);
  scene.setup.mouth = mouth;
  return scene;
}

/// The lower lip hangs so far that all of the interior shows.
State open_mouth() {
  State state = toy_state(80, 56);
  const Feature& inner = feature(FeatureId::kMouthInner);
  for (const int c : {4, 5, 6, 7}) state.control[inner.first_control + c].y = 1200;
  return state;
}

/// Position of a landmark, 1/64 pixel.
glm::ivec2 at_landmark(const Scene& scene, const State& state, std::size_t landmark) {
  return glm::ivec2(scene.geometry->project_vertices(state)[vertex_of_landmark(landmark)]);
}

/// Samples of a column of the picture down the middle of the open mouth.
/// @param fade  share of the opening to be left out on either side
std::vector<int> down_the_mouth(const Scene& scene, const State& state, double fade = 0.31) {
  const Picture out = rendered(scene, state);
  const glm::ivec2 top = at_landmark(scene, state, 62), bottom = at_landmark(scene, state, 66);
  const int first = top.y + static_cast<int>(fade * (bottom.y - top.y)), last = bottom.y - (first - top.y);
  std::vector<int> column;
  for (int y = (first + 31) / 64; y * 64 + 32 <= last; ++y) column.push_back(out.y.row(y)[top.x / 64]);
  return column;
}

constexpr YuvColour kGrey{100, 90, 160};

TEST(RendererMouth, ShowsUpperColourAboveAndLowerBelow) {
  const Scene scene = even_scene({{200, 90, 160}, {20, 90, 160}});
  const std::vector<int> column = down_the_mouth(scene, open_mouth());
  ASSERT_GT(column.size(), 3U) << "the case must occur";
  EXPECT_GT(column.front(), 130);
  EXPECT_LT(column.back(), 90);
  EXPECT_TRUE(std::is_sorted(column.rbegin(), column.rend()));
  const Picture out = rendered(scene, open_mouth());
  const auto reddish = [](const Plane& p, std::uint8_t value) {
    return std::count(p.samples.begin(), p.samples.end(), value);
  };
  EXPECT_GT(reddish(out.u, 90), 3);
  EXPECT_EQ(reddish(out.u, 90), reddish(out.v, 160));
}

TEST(RendererMouth, StateAddsAtTheUpperLipHalfWayAndAtTheLowerLip) {
  const Scene scene = even_scene({kGrey, kGrey});
  State state = open_mouth();
  for (const int v : down_the_mouth(scene, state)) EXPECT_EQ(v, 100);
  state.interior = {0, 16 * 60, 0};
  auto column = down_the_mouth(scene, state);
  const auto top = std::max_element(column.begin(), column.end());
  EXPECT_GT(*top, 145);
  EXPECT_LE(*top, 160);
  EXPECT_TRUE(std::is_sorted(column.begin(), top + 1) &&
              std::is_sorted(column.rbegin(), std::reverse_iterator(top)));
  EXPECT_LT(column.front(), 150);
  EXPECT_LT(column.back(), 150);
  state.interior = {16 * 60, 0, 0};
  column = down_the_mouth(scene, state);
  EXPECT_GT(column.front(), 110);
  EXPECT_EQ(column.back(), 100);
  state.interior = {0, 0, -16 * 60};
  column = down_the_mouth(scene, state);
  EXPECT_EQ(column.front(), 100);
  EXPECT_LT(column.back(), 90);
}

// 1/16 grey level, rounded to nearest with halves up; the middle from the mean of both colours.
TEST(RendererMouth, StateIsInSixteenthsAndRounded) {
  const auto even = [](YuvColour upper, YuvColour lower, std::array<std::int32_t, kInteriorCount> interior) {
    State state = open_mouth();
    state.interior = interior;
    const std::vector<int> column = down_the_mouth(even_scene({upper, lower}), state);
    EXPECT_EQ(std::count(column.begin(), column.end(), column[0]),
              static_cast<std::ptrdiff_t>(column.size()));
    return column[0];
  };
  EXPECT_EQ(even(kGrey, kGrey, {7, 7, 7}), 100);
  EXPECT_EQ(even(kGrey, kGrey, {8, 8, 8}), 101);
  EXPECT_EQ(even(kGrey, kGrey, {-8, -8, -8}), 100);
  EXPECT_EQ(even(kGrey, kGrey, {-9, -9, -9}), 99);
  EXPECT_EQ(even({100, 90, 160}, {110, 90, 160}, {16 * 10, 16 * 5, 0}), 110) << "half way is 105";
}

TEST(RendererMouth, StateIsClampedToBlackAndWhite) {
  State state = open_mouth();
  state.interior = {kMaxLight, kMaxLight, kMaxLight};
  for (const int v : down_the_mouth(even_scene({kGrey, kGrey}), state)) EXPECT_EQ(v, 255);
  state.interior = {-kMaxLight, -kMaxLight, -kMaxLight};
  for (const int v : down_the_mouth(even_scene({kGrey, kGrey}), state)) EXPECT_EQ(v, 0);
}

TEST(RendererMouth, StateLeavesChromaAndAllElseAlone) {
  const Scene scene = even_scene({kGrey, kGrey});
  State state = open_mouth();
  const Picture plain = rendered(scene, state);
  state.interior = {-1600, 1600, 1000};
  const Picture changed = rendered(scene, state);
  EXPECT_EQ(changed.u, plain.u);
  EXPECT_EQ(changed.v, plain.v);
  int other = 0;
  for (std::size_t i = 0; i < plain.y.samples.size(); ++i) {
    if (changed.y.samples[i] == plain.y.samples[i]) continue;
    ++other;
    ASSERT_NE(plain.y.samples[i], 230) << "only the interior";
  }
  EXPECT_GT(other, 10);
}

TEST(RendererMouth, FadesTowardsTheLips) {
  const Scene scene = even_scene({kGrey, kGrey});
  const std::vector<int> column = down_the_mouth(scene, open_mouth(), -0.1);
  ASSERT_GT(column.size(), 8U) << "the case must occur";
  const auto middle = column.begin() + static_cast<std::ptrdiff_t>(column.size() / 2);
  EXPECT_EQ(*middle, 100);
  EXPECT_EQ(column.front(), 230);
  EXPECT_EQ(column.back(), 230);
  EXPECT_TRUE(std::is_sorted(std::reverse_iterator(middle), column.rend()));
  EXPECT_TRUE(std::is_sorted(middle, column.end()));
  for (std::size_t k = 1; k < column.size(); ++k) EXPECT_LT(std::abs(column[k] - column[k - 1]), 80) << k;
}

// The curve through the vertices of a lip encloses more than the polygon of its vertices.
TEST(RendererMouth, LipsAreRound) {
  const Scene scene = even_scene({kGrey, kGrey});
  const Picture out = rendered(scene, open_mouth());
  const auto inside =
      std::count_if(out.y.samples.begin(), out.y.samples.end(), [](int v) { return v != 230; });
  std::int64_t polygon = 0;  // twice its area
  for (std::size_t landmark = 60; landmark < 68; ++landmark) {
    const glm::ivec2 a = at_landmark(scene, open_mouth(), landmark),
                     b = at_landmark(scene, open_mouth(), landmark == 67 ? 60 : landmark + 1);
    polygon += std::int64_t{a.x} * b.y - std::int64_t{b.x} * a.y;
  }
  EXPECT_GT(inside, polygon / 2 / 64 / 64);
}

TEST(RendererMouth, StillPatternHasNone) {
  Scene scene = even_scene({kGrey, kGrey});
  State state = open_mouth();
  state.blend[static_cast<std::size_t>(Region::kMouth)] = BlendMode::kStillBefore;
  EXPECT_EQ(rendered(scene, state).y, Plane(160, 128, 230));
}

TEST(RendererMouth, StateSaysNothingWhileTheLipsAreShut) {
  const Scene scene = even_scene({kGrey, kGrey});
  State state = toy_state(83, 55);
  const Picture plain = rendered(scene, state);
  state.interior = {1600, -1600, 1600};
  EXPECT_EQ(rendered(scene, state), plain);
}

}  // namespace
}  // namespace fbs
