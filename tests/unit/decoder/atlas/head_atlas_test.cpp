#include "decoder/atlas/head_atlas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "decoder/head/head_mesh.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

/// Luma that tells the place: a plane of a slope that a byte holds.
Picture ramp(int width, int height) {
  Picture out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) out.y.row(y)[x] = static_cast<std::uint8_t>(x / 2 + y / 2);
  for (Plane* plane : {&out.u, &out.v})
    for (int y = 0; y < plane->height; ++y)
      for (int x = 0; x < plane->width; ++x)
        plane->row(y)[x] = static_cast<std::uint8_t>(plane == &out.u ? 2 * x : 2 * y);
  return out;
}

HeadAtlas atlas_of(const AtlasLayout& layout, const Picture& picture, const TextureMesh& mesh) {
  HeadAtlas out;
  draw_atlas(layout, {picture.y, picture.u, picture.v}, mesh.head, mesh.light, out);
  return out;
}

// At the middle of each triangle of the head, luma equals the luma at the triangle's middle in the picture.
TEST(HeadAtlas, ShowsWhatThePatternShowsOfEachTriangle) {
  const Scene scene = toy_scene(ramp(160, 128));
  const AtlasLayout& layout = generic_atlas_layout(scene.geometry->rest_scale());
  const TextureMesh& mesh = scene.patterns[0].texture;
  const HeadAtlas atlas = atlas_of(layout, scene.patterns[0].picture, mesh);
  ASSERT_EQ(atlas.width(), layout.width);
  ASSERT_EQ(atlas.height(), layout.height);
  for (const HeadTriangle& t : generic_head_mesh().triangles) {
    const glm::dvec2 at(layout.points[t[0]] + layout.points[t[1]] + layout.points[t[2]]);
    const glm::dvec2 from(mesh.head[t[0]] + mesh.head[t[1]] + mesh.head[t[2]]);
    const auto x = static_cast<int>(at.x / 192), y = static_cast<int>(at.y / 192);
    // The nearest sample lies up to half a sample away, and small triangles are stretched to several.
    const double luma = (from.x / 192 + from.y / 192 - 1) / 2;
    EXPECT_NEAR(atlas.y.row(y)[x], luma, 2) << t[0];
    EXPECT_NEAR(atlas.u.row(y / 2)[x / 2], from.x / 192, 4) << t[0];
    EXPECT_NEAR(atlas.v.row(y / 2)[x / 2], from.y / 192, 4) << t[0];
  }
  EXPECT_EQ(atlas.y, scene.patterns[0].atlas.y) << "what a pattern keeps";
}

TEST(HeadAtlas, HasNoLightOfItsPattern) {
  State seen = toy_state();
  seen.light[kLightOffset] = 16 * 30;
  const Scene scene = toy_scene(Picture(160, 128));
  Picture grey(160, 128);
  grey.y = Plane(160, 128, 130);
  const AtlasLayout& layout = generic_atlas_layout(scene.geometry->rest_scale());
  const HeadAtlas atlas = atlas_of(layout, grey, scene.geometry->texture_mesh(seen));
  const auto luma_at = [&](std::size_t vertex) {
    const glm::ivec2 p = layout.points[vertex];
    return static_cast<int>(atlas.y.row(p.y >> 6)[p.x >> 6]);
  };
  EXPECT_EQ(luma_at(vertex_of_landmark(30)), 100) << "tip of the nose";
  EXPECT_NEAR(luma_at(vertex_of_landmark(8)), 100, 2) << "chin, an edge of the light";
  EXPECT_NEAR(luma_at(kVertexCount + 3), 130, 2) << "there is none on the ring";
}

TEST(HeadAtlas, DependsOnItsArgumentsAlone) {
  const Scene scene = toy_scene(ramp(160, 128));
  const TextureMesh& mesh = scene.patterns[0].texture;
  const AtlasLayout& layout = generic_atlas_layout(scene.geometry->rest_scale());
  const HeadAtlas first = atlas_of(layout, scene.patterns[0].picture, mesh);
  HeadAtlas used(layout.width, layout.height);
  const Picture other = noise_picture(160, 128, 1);
  draw_atlas(layout, {other.y, other.u, other.v}, mesh.head, {}, used);
  EXPECT_NE(used.y, first.y);
  const Picture& picture = scene.patterns[0].picture;
  draw_atlas(layout, {picture.y, picture.u, picture.v}, mesh.head, {}, used);
  for (const auto& t : layout.triangles) {
    const glm::ivec2 p = (layout.points[t[0]] + layout.points[t[1]] + layout.points[t[2]]) / 3;
    EXPECT_EQ(used.y.row(p.y >> 6)[p.x >> 6], first.y.row(p.y >> 6)[p.x >> 6]);
  }
}

}  // namespace
}  // namespace fbs
