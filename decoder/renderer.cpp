#include "decoder/renderer.h"

#include <algorithm>

namespace fbs {
namespace {

/// The planes of one scale and the part of them that may be drawn.
struct Layer {
  PlaneScale scale;
  std::vector<PlanePair> planes;
  SampleArea area;
};

SampleArea whole(const Plane& p) {
  return {0, 0, p.width, p.height};
}

RasterTriangle corners(const HeadTriangle& triangle, const ScreenMesh& now, const ScreenMesh& seen) {
  RasterTriangle t;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto v = triangle[i];
    t[i] = {{now.head[v].x, now.head[v].y}, {seen.head[v].x, seen.head[v].y}, now.head[v].z};
  }
  return t;
}

/// Samples that the head can cover, within `limit`.
SampleArea area_of_head(const ScreenMesh& now, PlaneScale scale, const SampleArea& limit) {
  glm::ivec2 low(kMaxScreen), high(-kMaxScreen);
  for (const glm::ivec3& p : now.head) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const int bits = static_cast<int>(scale);
  return {std::clamp(low.x >> bits, limit.x0, limit.x1), std::clamp(low.y >> bits, limit.y0, limit.y1),
          std::clamp((high.x >> bits) + 1, limit.x0, limit.x1),
          std::clamp((high.y >> bits) + 1, limit.y0, limit.y1)};
}

/// The cells of the surround's grid that have moved, over what stays.
void draw_surround(const Surround& surround, const ScreenMesh& now, const ScreenMesh& seen,
                   std::span<const Layer> layers) {
  const auto corner = [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    return RasterVertex{now.surround[i], surround.texture()[i], 0};
  };
  const auto still = [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    return now.surround[i] == seen.surround[i];
  };
  for (const Surround::Cell& cell : surround.cells()) {
    if (std::all_of(cell.begin(), cell.end(), still)) continue;  // the pattern already shows it
    const std::array<RasterVertex, 4> q = {corner(cell[0]), corner(cell[1]), corner(cell[2]),
                                           corner(cell[3])};
    for (const RasterTriangle& t : {RasterTriangle{q[0], q[1], q[2]}, RasterTriangle{q[0], q[2], q[3]}})
      for (const Layer& layer : layers) draw_triangle(t, layer.scale, layer.planes, layer.area, nullptr);
  }
}

/// The light that a picture has and its pattern has not.
Light light_on(const HeadTriangle& triangle, const ScreenMesh& now, const ScreenMesh& seen) {
  const auto at = [](const ScreenMesh& mesh, std::size_t v) {
    return mesh.light.empty() ? VertexLight{} : mesh.light[v];
  };
  Light out;
  for (std::size_t i = 0; i < 3; ++i) {
    const VertexLight a = at(now, triangle[i]), b = at(seen, triangle[i]);
    out.offset[i] = a.offset - b.offset;
    out.gain[i] = a.gain - b.gain;
  }
  return out;
}

void draw_head(const ScreenMesh& now, const ScreenMesh& seen, const Layer& layer, DepthPlane& depth) {
  const Plane& target = *layer.planes.front().target;
  const SampleArea area = area_of_head(now, layer.scale, layer.area);
  if (area.empty()) return;
  depth.reset(target.width, target.height, area);
  const std::int32_t shade_amount = mouth_shade(now.mouth_gap, seen.mouth_gap);
  for (const auto& triangle : head_mesh().triangles) {
    const bool inside_mouth = std::all_of(triangle.begin(), triangle.end(), is_inner_lip);
    Shade shade{{}, shade_amount};
    if (inside_mouth) std::transform(triangle.begin(), triangle.end(), shade.ramp.begin(), mouth_ramp);
    const bool lit = layer.scale == PlaneScale::kLuma && !(now.light.empty() && seen.light.empty());
    const Light light = lit ? light_on(triangle, now, seen) : Light{};
    draw_triangle(
        corners(triangle, now, seen), layer.scale, layer.planes, area, &depth,
        {.light = lit ? &light : nullptr, .shade = inside_mouth && shade_amount > 0 ? &shade : nullptr});
  }
}

/// One plane of the mouth's inside at the upper lip, half way and at the lower lip.
/// @param added  1/16 grey level
std::array<std::uint8_t, kInteriorCount> inside_of(const MouthInterior& mouth, std::uint8_t YuvColour::*plane,
                                                   const std::array<std::int32_t, kInteriorCount>& added) {
  const std::int32_t upper = 16 * (mouth.upper.*plane), lower = 16 * (mouth.lower.*plane);
  const std::array<std::int32_t, kInteriorCount> mean = {upper, (upper + lower) / 2, lower};
  std::array<std::uint8_t, kInteriorCount> colour{};
  for (std::size_t i = 0; i < kInteriorCount; ++i)
    colour[i] = static_cast<std::uint8_t>(std::clamp((mean[i] + added[i] + 8) >> 4, 0, 255));
  return colour;
}

}  // namespace

void Renderer::render(const Scene& scene, const State& state, Picture& out) {
  const Pattern& pattern = scene.patterns.front();
  out = pattern.picture;
  if (!scene.geometry) return;
  const ScreenMesh now = scene.geometry->project(state);
  const MouthInterior& mouth = scene.setup.mouth;
  const std::array<Layer, 2> layers = {
      Layer{PlaneScale::kLuma,
            {{&pattern.picture.y, &out.y, inside_of(mouth, &YuvColour::y, now.interior)}},
            whole(out.y)},
      Layer{PlaneScale::kChroma,
            {{&pattern.picture.u, &out.u, inside_of(mouth, &YuvColour::u, {})},
             {&pattern.picture.v, &out.v, inside_of(mouth, &YuvColour::v, {})}},
            whole(out.u)}};
  draw_surround(scene.geometry->surround(), now, pattern.seen, layers);
  draw_head(now, pattern.seen, layers[0], luma_depth_);
  draw_head(now, pattern.seen, layers[1], chroma_depth_);
}

}  // namespace fbs
