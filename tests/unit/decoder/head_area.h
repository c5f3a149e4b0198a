// Where a picture shows the head, by the winding of its polygons: the renderer's tests compare head and
// surround separately. The head passes through the atlas, sampled twice, so it is drawn closely; the rest is
// drawn exactly.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <vector>

#include "decoder/head/head_mesh.h"
#include "tests/unit/toy_scene.h"

namespace fbs {

/// How often the closed polygon winds around the centre of luma sample (x, y), clockwise.
inline int winding(const std::vector<glm::ivec2>& polygon, int x, int y) {
  const int px = x * 64 + 32, py = y * 64 + 32;
  int count = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::ivec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const std::int64_t side = std::int64_t{b.x - a.x} * (py - a.y) - std::int64_t{b.y - a.y} * (px - a.x);
    if (a.y <= py && b.y > py && side > 0) ++count;
    if (a.y > py && b.y <= py && side < 0) --count;
  }
  return count;
}

/// Sets the samples round (x, y) to 1.
inline void mark_round(Plane& plane, int x, int y, int radius) {
  for (int j = std::max(y - radius, 0); j <= std::min(y + radius, plane.height - 1); ++j)
    for (int i = std::max(x - radius, 0); i <= std::min(x + radius, plane.width - 1); ++i)
      plane.row(j)[i] = 1;
}

/// Luma samples round the head in which its silhouettes are softened; heads of these tests are small.
inline constexpr int kSoftenedBand = 3;

/// One where a triangle of the head faces the viewer and in the band round it, zero elsewhere; luma samples.
inline Plane head_area(const Scene& scene, const State& state) {
  const ScreenMesh mesh = scene.geometry->screen_mesh(state);
  Plane out(scene.setup.format.width, scene.setup.format.height, 0);
  for (const auto& t : generic_head_mesh().triangles) {
    std::vector<glm::ivec2> corners;
    for (const std::uint16_t v : t) corners.emplace_back(mesh.head[v]);
    const auto range = [](auto limits, int samples) {
      return std::pair{std::clamp(limits.first >> 6, 0, samples),
                       std::clamp((limits.second >> 6) + 1, 0, samples)};
    };
    const auto [left, right] = range(std::minmax({corners[0].x, corners[1].x, corners[2].x}), out.width);
    const auto [top, bottom] = range(std::minmax({corners[0].y, corners[1].y, corners[2].y}), out.height);
    for (int y = top; y < bottom; ++y)
      for (int x = left; x < right; ++x)
        if (winding(corners, x, y) > 0) mark_round(out, x, y, kSoftenedBand);
  }
  return out;
}

/// How far the samples of the head may lie from those expected.
struct Closeness {
  double mean;
  int worst;
};

/// Expects `plane` to be `expected`, exactly beside the head and closely within.
/// @param shown  head_area(); a chroma sample belongs to the head with any of its four luma samples
inline void expect_shows(const Plane& plane, const Plane& expected, const Plane& shown, Closeness head) {
  ASSERT_EQ(plane.width, expected.width);
  ASSERT_EQ(plane.height, expected.height);
  const int step = plane.width == shown.width ? 1 : 2;
  double sum = 0;
  int count = 0;
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      const int apart = std::abs(plane.row(y)[x] - expected.row(y)[x]);
      bool of_head = false;
      // A chroma triangle is tested at the chroma sample's place, which may lie beside its luma samples'.
      const int reach = step - 1;
      for (int j = y * step - reach; j < y * step + step + reach; ++j)
        for (int i = x * step - reach; i < x * step + step + reach; ++i)
          of_head =
              of_head || (j >= 0 && i >= 0 && j < shown.height && i < shown.width && shown.row(j)[i] != 0);
      if (!of_head) {
        ASSERT_EQ(apart, 0) << x << ',' << y << " of " << plane.width << " wide";
        continue;
      }
      ASSERT_LE(apart, head.worst) << x << ',' << y << " of " << plane.width << " wide";
      sum += apart;
      ++count;
    }
  }
  EXPECT_LE(sum, head.mean * count);
}

inline void expect_shows(const Picture& out, const Picture& expected, const Plane& shown, Closeness head) {
  expect_shows(out.y, expected.y, shown, head);
  expect_shows(out.u, expected.u, shown, head);
  expect_shows(out.v, expected.v, shown, head);
}

/// A picture whose head is not blurred by being sampled twice.
inline Picture smooth_picture(int width, int height, unsigned seed) {
  return picture_of(smooth_plane, width, height, seed);
}

}  // namespace fbs
