#include "decoder/draw/atlas_blend.h"

#include <gtest/gtest.h>

#include <array>

#include "decoder/head/head_mesh.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

/// Two atlases, each even in all planes, and a picture to draw.
struct Blending {
  const AtlasLayout& layout = generic_atlas_layout(64 << 16);
  std::array<HeadAtlas, 2> atlas{HeadAtlas(layout.width, layout.height),
                                 HeadAtlas(layout.width, layout.height)};
  ScreenMesh mesh;
  MeshBlend blend;
  Picture target{64, 64};
  SampleArea chroma{0, 0, 32, 32};

  Blending(std::uint8_t first, std::uint8_t second) {
    int grey = first;
    for (HeadAtlas& a : atlas) {
      a.y = Plane(layout.width, layout.height, static_cast<std::uint8_t>(grey));
      a.u = Plane(a.u.width, a.u.height, static_cast<std::uint8_t>(grey / 2));
      a.v = Plane(a.v.width, a.v.height, static_cast<std::uint8_t>(255 - grey));
      grey = second;
    }
    blend.sources = {{0, false}, {1, false}};
    blend.head.sources = 2;
    for (std::size_t v = 0; v < generic_head_mesh().vertex_count; ++v) set(v, kMeshWeightOne, 0);
  }

  void set(std::size_t vertex, std::int32_t first, std::int32_t second) {
    blend.head.weights.resize(2 * generic_head_mesh().vertex_count);
    blend.head.weights[2 * vertex] = first;
    blend.head.weights[2 * vertex + 1] = second;
  }

  std::array<ConstPlaneView, 3> drawn(AtlasBlend& to) {
    const Drawing drawing{mesh,
                          blend,
                          {{{}, nullptr, nullptr, &atlas[0]}, {{}, nullptr, nullptr, &atlas[1]}},
                          {},
                          {target.y, target.u, target.v},
                          {0, 0, 64, 64},
                          chroma};
    to.draw(drawing, head_weights(blend, generic_head()), layout);
    return to.planes();
  }

  /// Luma column and row where a landmark lies.
  [[nodiscard]] glm::ivec2 place(std::size_t landmark) const {
    return layout.points[vertex_of_landmark(landmark)] / 64;
  }
};

TEST(AtlasBlend, OneSourceIsCopied) {
  Blending b(0, 0);
  b.atlas[0].y = noise_plane(b.layout.width, b.layout.height, 1);
  AtlasBlend to;
  const auto planes = b.drawn(to);
  for (const glm::ivec2 block : b.layout.blocks)
    for (int y = 16 * block.y; y < 16 * block.y + 16; ++y)
      for (int x = 16 * block.x; x < 16 * block.x + 16; ++x)
        ASSERT_EQ(planes[0].row(y)[x], b.atlas[0].y.row(y)[x]) << x << ',' << y;
}

TEST(AtlasBlend, EvenWeightsGiveTheMeanInAllPlanes) {
  Blending b(60, 100);
  for (std::size_t v = 0; v < generic_head_mesh().vertex_count; ++v) b.set(v, 1024, 3072);
  AtlasBlend to;
  const auto planes = b.drawn(to);
  const glm::ivec2 nose = b.place(30);
  EXPECT_EQ(planes[0].row(nose.y)[nose.x], 90);
  EXPECT_EQ(planes[1].row(nose.y / 2)[nose.x / 2], 45);
  EXPECT_EQ(planes[2].row(nose.y / 2)[nose.x / 2], 165);
}

TEST(AtlasBlend, WeightsFadeFromVertexToVertex) {
  Blending b(50, 200);
  for (const std::size_t landmark :
       {48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 65, 66, 67})
    b.set(vertex_of_landmark(landmark), 0, kMeshWeightOne);
  AtlasBlend to;
  const auto planes = b.drawn(to);
  const auto luma = [&](glm::ivec2 p) { return static_cast<int>(planes[0].row(p.y)[p.x]); };
  EXPECT_EQ(luma(b.place(36)), 50) << "an eye";
  EXPECT_GT(luma((b.place(62) + b.place(66)) / 2), 190) << "the lips";
  const glm::ivec2 nose = b.place(33), lip = b.place(51);
  const int between = luma((nose + lip) / 2);
  EXPECT_TRUE(between > 70 && between < 180) << between;
}

TEST(AtlasBlend, WithoutChromaOnlyLumaIsDrawn) {
  Blending b(60, 100);
  b.chroma = {};
  AtlasBlend to;
  const auto planes = b.drawn(to);
  const glm::ivec2 nose = b.place(30);
  EXPECT_EQ(planes[0].row(nose.y)[nose.x], 60);
  EXPECT_NE(planes[1].row(nose.y / 2)[nose.x / 2], 30);
}

}  // namespace
}  // namespace fbs
