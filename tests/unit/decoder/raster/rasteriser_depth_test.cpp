#include <gtest/gtest.h>

#include <vector>

#include "decoder/raster/rasteriser.h"
#include "tests/unit/decoder/raster/textured_triangle.h"

namespace fbs {
namespace {

/// A triangle of one grey level.
struct Painted {
  TexturedTriangle triangle;
  int grey;
};

Painted painted(TexturedTriangle t, int grey, std::array<std::int32_t, 3> depth) {
  for (std::size_t k = 0; k < t.size(); ++k) t[k].depth = depth[k];
  return {t, grey};
}

/// Draws triangles into a plane of 24 x 20 samples.
Plane drawn(const std::vector<Painted>& triangles, Rasteriser& raster,
            const SampleArea& area = {0, 0, 24, 20}) {
  Plane target(24, 20), greys(256, 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 256; ++x) greys.row(y)[x] = static_cast<std::uint8_t>(x);
  const ConstPlaneView from = greys;
  const PlaneView to = target;
  raster.start(PlaneScale::kLuma, area, {{&from, 1}, LightUse::kNone, {}, {&to, 1}});
  for (const Painted& p : triangles) {
    const glm::ivec2 at(64 * p.grey + 32, 32);
    raster.add(screen_of(p.triangle), {{at, at, at}});
  }
  raster.draw();
  return target;
}
Plane drawn(const std::vector<Painted>& triangles) {
  Rasteriser raster;
  return drawn(triangles, raster);
}

TEST(RasteriserDepth, NearerHidesFartherInEitherOrder) {
  const TexturedTriangle small = in_place({300, 200}, {1000, 300}, {500, 900});
  const Painted near_one = painted(small, 200, {-5, -7, -9}), far_one = painted(kLarge, 50, {10, 20, 30});
  const Plane target = drawn({near_one, far_one});
  EXPECT_EQ(target, drawn({far_one, near_one}));
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 24; ++x)
      EXPECT_EQ(target.row(y)[x], covers(small, PlaneScale::kLuma, x, y) ? 200 : 50);
}

TEST(RasteriserDepth, EqualDepthKeepsWhatWasThere) {
  EXPECT_EQ(drawn({painted(kLarge, 1, {7, 7, 7}), painted(kLarge, 2, {7, 7, 7})}), Plane(24, 20, 1));
}

// Depth x against depth 12 samples: they cross in the middle of the picture.
TEST(RasteriserDepth, TrianglesThatPassThroughEachOtherMeetWhereDepthsAreEqual) {
  Painted slanted{kLarge, 2};
  for (TexturedVertex& v : slanted.triangle) v.depth = v.screen.x;
  const Plane target = drawn({painted(kLarge, 1, {768, 768, 768}), slanted});
  for (int x = 0; x < 24; ++x) EXPECT_EQ(target.row(9)[x], x < 12 ? 2 : 1) << x;
}

TEST(RasteriserDepth, StartForgetsWhatWasDrawn) {
  Rasteriser raster;
  (void)drawn({painted(kLarge, 1, {0, 0, 0})}, raster);
  const Plane target = drawn({painted(kLarge, 2, {5, 5, 5})}, raster, {4, 4, 10, 10});
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 24; ++x) EXPECT_EQ(target.row(y)[x], x >= 4 && x < 10 && y >= 4 && y < 10 ? 2 : 0);
}

}  // namespace
}  // namespace fbs
