// draw_triangle with a DepthPlane.
#include <gtest/gtest.h>

#include "decoder/raster/rasteriser.h"
#include "tests/unit/decoder/raster/textured_triangle.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

TexturedTriangle at_depth(TexturedTriangle t, int a, int b, int c) {
  t[0].depth = a;
  t[1].depth = b;
  t[2].depth = c;
  return t;
}

TEST(RasteriserDepth, NearerHidesFartherInEitherOrder) {
  const Plane near_paint(24, 20, 200), far_paint(24, 20, 50);
  const TexturedTriangle small = in_place({300, 200}, {1000, 300}, {500, 900});
  const auto near_one = at_depth(small, -5, -7, -9), far_one = at_depth(kLarge, 10, 20, 30);
  std::array<Plane, 2> target = {Plane(24, 20), Plane(24, 20)};
  for (std::size_t order = 0; order < 2; ++order) {
    DepthPlane depth;
    depth.reset(24, 20, whole(target[order]));
    for (std::size_t k = 0; k < 2; ++k) {
      if (k == order)
        draw(near_one, PlaneScale::kLuma, near_paint, target[order], &depth);
      else
        draw(far_one, PlaneScale::kLuma, far_paint, target[order], &depth);
    }
  }
  EXPECT_EQ(target[0], target[1]);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 24; ++x)
      EXPECT_EQ(target[0].row(y)[x], covers(small, PlaneScale::kLuma, x, y) ? 200 : 50);
}

TEST(RasteriserDepth, EqualDepthKeepsWhatWasThere) {
  Plane target(24, 20);
  DepthPlane depth;
  depth.reset(24, 20, whole(target));
  draw(at_depth(kLarge, 7, 7, 7), PlaneScale::kLuma, Plane(24, 20, 1), target, &depth);
  draw(at_depth(kLarge, 7, 7, 7), PlaneScale::kLuma, Plane(24, 20, 2), target, &depth);
  EXPECT_EQ(target, Plane(24, 20, 1));
}

// Depth x against depth 12 samples: they cross in the middle of the picture.
TEST(RasteriserDepth, TrianglesThatPassThroughEachOtherMeetWhereDepthsAreEqual) {
  Plane target(24, 20);
  DepthPlane depth;
  depth.reset(24, 20, whole(target));
  auto slanted = kLarge;
  for (TexturedVertex& v : slanted) v.depth = v.screen.x;
  draw(at_depth(kLarge, 768, 768, 768), PlaneScale::kLuma, Plane(24, 20, 1), target, &depth);
  draw(slanted, PlaneScale::kLuma, Plane(24, 20, 2), target, &depth);
  for (int x = 0; x < 24; ++x) EXPECT_EQ(target.row(9)[x], x < 12 ? 2 : 1) << x;
}

TEST(RasteriserDepth, ResetClearsTheAreaAlone) {
  Plane target(24, 20);
  DepthPlane depth;
  depth.reset(24, 20, whole(target));
  draw(at_depth(kLarge, 0, 0, 0), PlaneScale::kLuma, Plane(24, 20, 1), target, &depth);
  depth.reset(24, 20, {4, 4, 10, 10});
  draw(at_depth(kLarge, 5, 5, 5), PlaneScale::kLuma, Plane(24, 20, 2), target, &depth);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 24; ++x) EXPECT_EQ(target.row(y)[x], x >= 4 && x < 10 && y >= 4 && y < 10 ? 2 : 1);
}

}  // namespace
}  // namespace fbs
