#include "decoder/pattern/contrast_map.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "bitstream/syntax.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr int kWidth = 160, kHeight = 128;

Scene scene() {
  return toy_scene(Picture(kWidth, kHeight));
}

/// That of the scene's pattern.
ContrastMap map_of(const Setup& setup) {
  const Scene toy = scene();
  return {setup, toy.geometry->geometry(), toy.patterns.front().seen};
}

/// @param contrast  of the surround
Setup setup(std::int32_t contrast, int width = kWidth, int height = kHeight) {
  Setup out;
  out.format.width = width;
  out.format.height = height;
  out.contrast = contrast;
  return out;
}

/// Two grey levels in turn.
Picture two_levels(std::uint8_t low, std::uint8_t high) {
  Picture out(kWidth, kHeight);
  for (Plane* plane : {&out.y, &out.u, &out.v})
    for (std::size_t i = 0; i < plane->samples.size(); ++i) plane->samples[i] = i % 2 == 0 ? low : high;
  return out;
}

/// A sample in the middle of the face.
glm::ivec2 middle() {
  const Scene toy = scene();
  glm::ivec2 sum{0, 0};
  for (std::size_t v = 0; v < kVertexCount; ++v) sum += toy.patterns.front().texture.head[v];
  return sum / static_cast<int>(kVertexCount) / 64;
}

TEST(ContrastMap, FullInTheFaceAndLessOutsideIt) {
  Picture p = two_levels(28, 228);
  map_of(setup(128)).reduce(p);
  const glm::ivec2 in = middle();
  EXPECT_EQ(std::abs(p.y.row(in.y)[in.x] - 128), 100);
  EXPECT_EQ(std::abs(p.y.row(1)[1] - 128), 50);
  EXPECT_EQ(p.u.samples, two_levels(28, 228).u.samples);
}

// At contrast c one level is 256 / c levels of the pattern, rounded twice.
TEST(ContrastMap, ExpandGivesBackWhatReduceTook) {
  for (const std::int32_t surround : {kMinContrast, 205, 255, kContrastOne}) {
    const ContrastMap map = map_of(setup(surround));
    for (int level = 0; level < 256; level += 5) {
      const Picture original =
          two_levels(static_cast<std::uint8_t>(level), static_cast<std::uint8_t>(255 - level));
      Picture p = original;
      map.reduce(p);
      map.expand(p);
      for (std::size_t i = 0; i < p.y.samples.size(); ++i)
        ASSERT_NEAR(p.y.samples[i], original.y.samples[i], surround == kContrastOne ? 0 : 1);
    }
  }
}

TEST(ContrastMap, RaisesAllChroma) {
  auto raised = setup(192);
  raised.chroma_contrast = 384;
  const ContrastMap map = map_of(raised);
  Picture p = two_levels(168, 168);
  map.reduce(p);
  const glm::ivec2 in = middle();
  EXPECT_EQ(p.y.row(in.y)[in.x], 168);
  EXPECT_EQ(p.u.row(in.y / 2)[in.x / 2], 128 + 60);
  EXPECT_EQ(p.v.row(1)[1], 128 + 60);
  map.expand(p);
  for (const std::uint8_t v : p.u.samples) EXPECT_NEAR(v, 168, 1);
}

// SPEC 11.7. Samples wholly inside the face or outside it are looked up in tables.
TEST(ContrastMap, ExpandsEachLevelByTheRule) {
  auto raised = setup(200);
  raised.chroma_contrast = 384;
  const ContrastMap map = map_of(raised);
  const glm::ivec2 in = middle();
  for (int level = 0; level < 256; ++level) {
    const auto expanded = [&](int contrast) {
      const int inverse = ((256 << 16) + contrast / 2) / contrast;
      return std::clamp(128 + (((level - 128) * inverse + (1 << 15)) >> 16), 0, 255);
    };
    Picture p = two_levels(static_cast<std::uint8_t>(level), static_cast<std::uint8_t>(level));
    map.expand(p);
    ASSERT_EQ(p.y.row(in.y)[in.x], level);
    ASSERT_EQ(p.y.row(1)[1], expanded(200)) << level;
    for (const Plane* plane : {&p.u, &p.v})
      for (const std::uint8_t sample : plane->samples) ASSERT_EQ(sample, expanded(384)) << level;
  }
}

TEST(ContrastMap, LargestDeviationsStayInRange) {
  Picture p = two_levels(0, 255);
  map_of(setup(kMinContrast)).expand(p);
  EXPECT_EQ(p.y.row(1)[0], 0);
  EXPECT_EQ(p.y.row(1)[1], 255);
}

TEST(ContrastMap, ChangesOverAWideBand) {
  Picture p = two_levels(228, 228);
  map_of(setup(kMinContrast)).reduce(p);
  int between = 0;
  for (const std::uint8_t v : p.y.samples) between += v > 185 && v < 221;
  EXPECT_GT(between, 50);
}

// The ring reaches beyond the picture's border, and chroma of an odd size has a sample more than half.
TEST(ContrastMap, TakesAnySize) {
  for (const auto& [w, h] : {std::pair{16, 16}, {17, 33}, {161, 127}}) {
    Picture p(w, h);
    for (auto& v : p.y.samples) v = 200;
    const Picture before = p;
    const ContrastMap map = map_of(setup(200, w, h));
    map.reduce(p);
    EXPECT_NE(p.y.samples, before.y.samples);
    map.expand(p);
    for (const std::uint8_t v : p.y.samples) EXPECT_NEAR(v, 200, 1);
  }
}

}  // namespace
}  // namespace fbs
