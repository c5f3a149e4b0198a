#include "decoder/head/mouth_interior.h"

#include <gtest/gtest.h>

#include <random>

#include "decoder/head/head_deformation.h"
#include "decoder/head/head_mesh.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

TEST(MouthInterior, OpacityGrowsAsTheLipsPart) {
  EXPECT_EQ(interior_opacity(-500, 100), 0);
  EXPECT_EQ(interior_opacity(100, 100), 0) << "as the pattern saw it";
  EXPECT_EQ(interior_opacity(200, 100), 0) << "the pattern's own, stretched";
  EXPECT_EQ(interior_opacity(328, 100), 128);
  EXPECT_EQ(interior_opacity(28, -100), 128) << "lips that overlap in the pattern";
  EXPECT_EQ(interior_opacity(5000, 100), 256);
}

TEST(MouthInterior, GapIsThatOfTheInnerLips) {
  State open;
  const Feature& inner = feature(FeatureId::kMouthInner);
  const Geometry neutral = toy_geometry();
  for (const FeatureVertex& v : inner.vertices) EXPECT_TRUE(is_inner_lip(generic_head(), v.vertex));
  for (int i = 0; i < inner.control_count; ++i)
    open.control[inner.first_control + i].y = i >= inner.control_count / 2 ? 800 : 0;
  EXPECT_GT(mouth_gap(neutral, open), mouth_gap(neutral, {}) + 400);
  for (std::size_t v = kVertexCount; v < generic_head_mesh().vertex_count; ++v)
    EXPECT_FALSE(is_inner_lip(generic_head(), v)) << "a ring vertex";
}

TEST(MouthInterior, RampGoesFromTheUpperToTheLowerInnerLip) {
  const auto at = [](std::size_t landmark) {
    return mouth_ramp(generic_head(), vertex_of_landmark(landmark));
  };
  for (const std::size_t upper : {61U, 62U, 63U}) EXPECT_EQ(at(upper), 0);
  for (const std::size_t corner : {60U, 64U}) EXPECT_EQ(at(corner), kMouthRampEnd / 2);
  for (const std::size_t lower : {65U, 66U, 67U}) EXPECT_EQ(at(lower), kMouthRampEnd);
}

TEST(MouthInterior, InnerLipsGoFromCornerToCorner) {
  const InnerLips lips = inner_lips(generic_head());
  const auto vertices = [](std::initializer_list<std::size_t> landmarks) {
    std::vector<std::uint16_t> out;
    for (const std::size_t k : landmarks)
      out.push_back(static_cast<std::uint16_t>(generic_head().vertex_of_landmark(k)));
    return out;
  };
  EXPECT_EQ(lips.upper, vertices({60, 61, 62, 63, 64}));
  EXPECT_EQ(lips.lower, vertices({60, 67, 66, 65, 64}));
}

// SPEC 10.10, word for word.
TEST(MouthInterior, SampleIsMixedByTheFormatsFormula) {
  std::mt19937 random(10);
  for (int i = 0; i < 20000; ++i) {
    const auto level = [&] { return static_cast<std::uint8_t>(random()); };
    const InteriorColours c = {level(), level(), level()};
    const int v = level(), at = static_cast<int>(random() % 257), opacity = static_cast<int>(random() % 257);
    const int colour = at < 128 ? (c[0] * (128 - at) + c[1] * at + 64) >> 7
                                : (c[1] * (256 - at) + c[2] * (at - 128) + 64) >> 7;
    ASSERT_EQ(with_interior(static_cast<std::uint8_t>(v), c, at, opacity),
              (v * (256 - opacity) + colour * opacity + 128) >> 8);
  }
}

// SPEC 10.10: 1/16 grey level, rounded to nearest with halves up.
TEST(MouthInterior, ColoursAreTheSetupsPlusTheStates) {
  const MouthInterior mouth{{101, 90, 160}, {20, 93, 250}};
  EXPECT_EQ(interior_base(mouth, &YuvColour::y), (std::array<std::int32_t, 3>{1616, 968, 320}));
  const auto colours = [&](const std::array<std::int32_t, kInteriorCount>& added_luma) {
    return interior_colours(mouth, added_luma);
  };
  const InteriorColours u = {90, 92, 93}, v = {160, 205, 250};
  using Planes = std::array<InteriorColours, 3>;
  EXPECT_EQ(colours({}), (Planes{{{101, 61, 20}, u, v}})) << "60.5 goes up";
  EXPECT_EQ(colours({7, -1, -8}), (Planes{{{101, 60, 20}, u, v}}));
  EXPECT_EQ(colours({-kMaxLight, 0, -9}), (Planes{{{0, 61, 19}, u, v}}));
  EXPECT_EQ(colours({kMaxLight, 0, kMaxLight}), (Planes{{{255, 61, 255}, u, v}}));
}

}  // namespace
}  // namespace fbs
