#include "decoder/renderer.h"

#include <algorithm>

namespace fbs {
namespace {

RasterTriangle corners(const std::array<std::int16_t, 3>& triangle, const ScreenMesh& now, const ScreenMesh& seen) {
  RasterTriangle t;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto v = static_cast<std::size_t>(triangle[i]);
    t[i] = {{now.head[v].x, now.head[v].y}, {seen.head[v].x, seen.head[v].y}, now.head[v].z};
  }
  return t;
}

}  // namespace

void Renderer::render(const Scene& scene, const State& state, Picture& out) {
  const Pattern& pattern = scene.patterns.front();
  out = pattern.picture;
  if (!scene.geometry) return;
  const ScreenMesh now = scene.geometry->project(state);
  draw_surround(scene, pattern, now, out);
  draw_head(pattern, now, out);
}

void Renderer::draw_surround(const Scene& scene, const Pattern& pattern, const ScreenMesh& now, Picture& out) {
  const SurroundMap& map = scene.geometry->surround();
  const int stride = map.columns + 1;
  const auto corner = [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    return RasterVertex{now.surround[i], pattern.seen.surround[i], 0};
  };
  // What follows the head most is drawn last, over what stays.
  for (int follow = 1; follow <= 4 * kFollowOne; ++follow) {
    for (int r = 0; r < map.rows; ++r) {
      for (int c = 0; c < map.columns; ++c) {
        const int k = r * stride + c;
        const std::array<int, 4> at = {k, k + 1, k + stride + 1, k + stride};
        int sum = 0;
        for (const int i : at) sum += map.follow[static_cast<std::size_t>(i)];
        if (sum != follow) continue;
        const std::array<RasterVertex, 4> q = {corner(at[0]), corner(at[1]), corner(at[2]), corner(at[3])};
        const auto still = [](const RasterVertex& v) { return v.screen == v.texture; };
        if (std::all_of(q.begin(), q.end(), still)) continue;  // pattern 0 already shows it
        for (const RasterTriangle& t : {RasterTriangle{q[0], q[1], q[2]}, RasterTriangle{q[0], q[2], q[3]}}) {
          draw_triangle(t, pattern.picture.y, PlaneScale::kLuma, out.y, nullptr);
          draw_triangle(t, pattern.picture.u, PlaneScale::kChroma, out.u, nullptr);
          draw_triangle(t, pattern.picture.v, PlaneScale::kChroma, out.v, nullptr);
        }
      }
    }
  }
}

void Renderer::draw_head(const Pattern& pattern, const ScreenMesh& now, Picture& out) {
  luma_depth_.reset(out.y.width, out.y.height);
  chroma_u_depth_.reset(out.u.width, out.u.height);
  chroma_v_depth_.reset(out.v.width, out.v.height);
  for (const auto& triangle : head_mesh().triangles) {
    const RasterTriangle t = corners(triangle, now, pattern.seen);
    draw_triangle(t, pattern.picture.y, PlaneScale::kLuma, out.y, &luma_depth_);
    draw_triangle(t, pattern.picture.u, PlaneScale::kChroma, out.u, &chroma_u_depth_);
    draw_triangle(t, pattern.picture.v, PlaneScale::kChroma, out.v, &chroma_v_depth_);
  }
}

}  // namespace fbs
