#include "encoder/blend/visible_surface.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/encoder/blend/blended_scene.h"

namespace fbs {
namespace {

VisibleSurface surface_of(const BlendedScene& s, const State& state, int reduction) {
  const VideoFormat& format = s.scene.setup.format;
  return {*s.scene.geometry, s.scene.geometry->screen_mesh(state), format.width, format.height, reduction};
}

State turned() {
  State state = SeenScene::rest();
  StateMaker maker(5);
  maker.pose(state), maker.expression(state), maker.mouth(state);
  return state;
}

TEST(VisibleSurface, EverySampleBelongsToOneRun) {
  for (const auto& [width, height] : {std::pair{320, 240}, {321, 243}}) {
    const BlendedScene s(1, 1, width, height);
    for (int reduction = 0; reduction <= 3; ++reduction) {
      const VisibleSurface surface = surface_of(s, turned(), reduction);
      EXPECT_EQ(surface.width(), width >> reduction);
      EXPECT_EQ(surface.height(), height >> reduction);
      std::vector<int> shown(static_cast<std::size_t>(surface.width()) * surface.height());
      for (const SurfaceRun& run : surface.runs()) {
        ASSERT_GE(run.first, 0);
        ASSERT_LE(run.first + run.count, surface.width());
        ASSERT_LT(run.row, surface.height());
        for (int i = 0; i < run.count; ++i) ++shown[run.row * surface.width() + run.first + i];
      }
      EXPECT_EQ(std::count(shown.begin(), shown.end(), 1), static_cast<std::ptrdiff_t>(shown.size()))
          << width << 'x' << height << " reduced by " << reduction;
    }
  }
}

TEST(VisibleSurface, PositionsLieInsideTheirTriangle) {
  const BlendedScene s(1);
  for (int reduction = 0; reduction <= 2; ++reduction) {
    const VisibleSurface surface = surface_of(s, turned(), reduction);
    for (const SurfaceRun& run : surface.runs()) {
      const Barycentric& b = surface.barycentric(run.triangle);
      for (const int column : {run.first, run.first + run.count - 1}) {
        const glm::vec2 at =
            b.origin + static_cast<float>(column) * b.per_column + static_cast<float>(run.row) * b.per_row;
        EXPECT_GT(at.x, -0.01F);
        EXPECT_GT(at.y, -0.01F);
        EXPECT_LT(at.x + at.y, 1.01F);
      }
    }
  }
}

TEST(VisibleSurface, RunsComeTriangleByTriangle) {
  const BlendedScene s(1);
  const VisibleSurface surface = surface_of(s, turned(), 1);
  std::size_t runs = 0;
  for (std::uint32_t k = 0; k < surface.triangles().size(); ++k)
    for (const SurfaceRun& run : surface.runs_of(k)) {
      EXPECT_EQ(run.triangle, k);
      EXPECT_EQ(&run, &surface.runs()[runs++]);
    }
  EXPECT_EQ(runs, surface.runs().size());
}

TEST(VisibleSurface, HeadHidesTheSurround) {
  const BlendedScene s(1);
  const VisibleSurface surface = surface_of(s, SeenScene::rest(), 0);
  const auto shows_head = [&](int column, int row) {
    const auto run = std::ranges::find_if(surface.runs(), [&](const SurfaceRun& r) {
      return r.row == row && r.first <= column && column < r.first + r.count;
    });
    return surface.triangles()[run->triangle].head;
  };
  EXPECT_TRUE(shows_head(160, 120)) << "half an eye distance below the eyes";
  EXPECT_FALSE(shows_head(0, 0));
  std::size_t head = 0;
  for (const SurfaceRun& run : surface.runs())
    if (surface.triangles()[run.triangle].head) head += run.count;
  EXPECT_GT(head, 48U * 48U) << "more than a square of the eye distance";
}

}  // namespace
}  // namespace fbs
