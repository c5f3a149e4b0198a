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

/// Samples of a column of the picture down the middle of the open mouth, a pixel within the lips.
std::vector<int> down_the_mouth(const Scene& scene, const State& state) {
  const Picture out = rendered(scene, state);
  const auto vertices = scene.geometry->project_vertices(state);
  const auto at = [&](std::size_t landmark) { return glm::ivec2(vertices[vertex_of_landmark(landmark)]); };
  const glm::ivec2 top = at(62), bottom = at(66);
  std::vector<int> column;
  for (int y = (top.y + 95) / 64; y * 64 + 96 < bottom.y; ++y) column.push_back(out.y.row(y)[top.x / 64]);
  return column;
}

constexpr YuvColour kGrey{100, 90, 160};

TEST(RendererMouth, ShowsUpperColourAboveAndLowerBelow) {
  const Scene scene = even_scene({{200, 90, 160}, {20, 90, 160}});
  const std::vector<int> column = down_the_mouth(scene, open_mouth());
  ASSERT_GT(column.size(), 6U) << "the case must occur";
  EXPECT_GT(column.front(), 170);
  EXPECT_LT(column.back(), 50);
  EXPECT_TRUE(std::is_sorted(column.rbegin(), column.rend()));
  const Picture out = rendered(scene, open_mouth());
  const auto reddish = [](const Plane& p, std::uint8_t value) {
    return std::count(p.samples.begin(), p.samples.end(), value);
  };
  EXPECT_GT(reddish(out.u, 90), 10);
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
  EXPECT_LT(column.front(), 125);
  EXPECT_LT(column.back(), 125);
  state.interior = {16 * 60, 0, 0};
  column = down_the_mouth(scene, state);
  EXPECT_GT(column.front(), 135);
  EXPECT_EQ(column.back(), 100);
  state.interior = {0, 0, -16 * 60};
  column = down_the_mouth(scene, state);
  EXPECT_EQ(column.front(), 100);
  EXPECT_LT(column.back(), 65);
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
    ASSERT_EQ(plain.y.samples[i], kGrey.y) << "only the interior";
  }
  EXPECT_GT(other, 10);
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
