#include "decoder/renderer.h"

#include <algorithm>
#include <span>

#include "decoder/head/head_mesh.h"
#include "decoder/head/mouth_interior.h"
#include "decoder/raster/rasteriser.h"

namespace fbs {
namespace {

/// The planes of one scale: the pattern's, the picture's, and the colours of the mouth interior in them.
struct Layer {
  std::span<const ConstPlaneView> textures;
  RasterTarget target;  ///< all samples, without depth
  std::span<const InteriorColours> interior;
};

ScreenTriangle on_screen(const HeadTriangle& triangle, const ScreenMesh& mesh) {
  ScreenTriangle t;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::ivec3 p = mesh.head[triangle[i]];
    t[i] = {{p.x, p.y}, p.z};
  }
  return t;
}

std::array<glm::ivec2, 3> in_texture(const HeadTriangle& triangle, const TextureMesh& texture) {
  return {texture.head[triangle[0]], texture.head[triangle[1]], texture.head[triangle[2]]};
}

/// Samples that the head can cover, within `limit`.
SampleArea area_of_head(const ScreenMesh& mesh, PlaneScale scale, const SampleArea& limit) {
  glm::ivec2 low(kMaxScreen), high(-kMaxScreen);
  for (const glm::ivec3& p : mesh.head) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const int bits = static_cast<int>(scale);
  return {std::clamp(low.x >> bits, limit.x0, limit.x1), std::clamp(low.y >> bits, limit.y0, limit.y1),
          std::clamp((high.x >> bits) + 1, limit.x0, limit.x1),
          std::clamp((high.y >> bits) + 1, limit.y0, limit.y1)};
}

/// The cells of the surround's grid that lie elsewhere than the pattern saw them, over a copy of the pattern.
void draw_surround(const std::vector<Surround::Cell>& cells, const ScreenMesh& mesh,
                   const TextureMesh& texture, std::span<const Layer> layers) {
  const auto still = [&](int k) { return mesh.surround[k] == texture.seen_surround[k]; };
  const auto draw = [&](int a, int b, int c) {
    const ScreenTriangle t = {{{mesh.surround[a]}, {mesh.surround[b]}, {mesh.surround[c]}}};
    const std::array<glm::ivec2, 3> in = {texture.surround[a], texture.surround[b], texture.surround[c]};
    for (const Layer& layer : layers) draw_triangle(t, {layer.textures, in}, layer.target);
  };
  for (const Surround::Cell& cell : cells) {
    if (std::all_of(cell.begin(), cell.end(), still)) continue;
    draw(cell[0], cell[1], cell[2]);
    draw(cell[0], cell[2], cell[3]);
  }
}

/// The light that the picture has and the pattern has not.
Light light_over(const HeadTriangle& triangle, const ScreenMesh& mesh, const TextureMesh& texture) {
  const auto at = [](const std::vector<VertexLight>& light, std::size_t v) {
    return light.empty() ? VertexLight{} : light[v];
  };
  Light out;
  for (std::size_t i = 0; i < 3; ++i) {
    const VertexLight now = at(mesh.light, triangle[i]), seen = at(texture.light, triangle[i]);
    out.offset[i] = now.offset - seen.offset;
    out.gain[i] = now.gain - seen.gain;
  }
  return out;
}

void draw_head(const ScreenMesh& mesh, const TextureMesh& texture, const Layer& layer, DepthPlane& depth) {
  RasterTarget target = layer.target;
  target.area = area_of_head(mesh, target.scale, target.area);
  if (target.area.empty()) return;
  depth.reset(target.planes.front().width, target.planes.front().height, target.area);
  target.depth = &depth;
  const std::int32_t opacity = interior_opacity(mesh.mouth_gap, texture.mouth_gap);
  const bool lit = target.scale == PlaneScale::kLuma && !(mesh.light.empty() && texture.light.empty());
  for (const HeadTriangle& triangle : head_mesh().triangles) {
    InteriorMix mix{{}, opacity, layer.interior};
    const bool interior = opacity > 0 && std::all_of(triangle.begin(), triangle.end(), is_inner_lip);
    if (interior) std::transform(triangle.begin(), triangle.end(), mix.ramp.begin(), mouth_ramp);
    const Light light = lit ? light_over(triangle, mesh, texture) : Light{};
    draw_triangle(on_screen(triangle, mesh), {layer.textures, in_texture(triangle, texture)}, target,
                  {.light = lit ? &light : nullptr, .interior = interior ? &mix : nullptr});
  }
}

void copy(const ConstPlaneView& from, const PlaneView& to) {
  for (int y = 0; y < from.height; ++y) std::copy_n(from.row(y), from.width, to.row(y));
}

bool same_size(const ConstPlaneView& a, const ConstPlaneView& b) {
  return a.width == b.width && a.height == b.height;
}

bool fits(const TextureMesh& texture, const SceneGeometry& geometry) {
  const std::size_t points = geometry.surround().point_count();
  return texture.head.size() == head_mesh().vertex_count && texture.surround.size() == points &&
         texture.seen_surround.size() == points;
}

Result<void> check(const Scene& scene) {
  if (scene.patterns.empty()) return fail(ErrorCode::kInvalidArgument, "the scene has no pattern yet");
  if (scene.geometry && !fits(scene.patterns.front().texture, *scene.geometry))
    return fail(ErrorCode::kInvalidArgument, "the pattern's texture mesh is not of the scene's geometry");
  return {};
}

}  // namespace

Result<void> Renderer::render(const Scene& scene, const State& state, const PictureView& out) {
  if (auto checked = check(scene); !checked) return checked;
  const Pattern& pattern = scene.patterns.front();
  const std::array<ConstPlaneView, 3> textures = {pattern.picture.y, pattern.picture.u, pattern.picture.v};
  const std::array<PlaneView, 3> targets = {out.y, out.u, out.v};
  if (!std::equal(textures.begin(), textures.end(), targets.begin(), same_size))
    return fail(ErrorCode::kInvalidArgument, "the picture to draw into has another size than the scene");
  for (std::size_t i = 0; i < targets.size(); ++i) copy(textures[i], targets[i]);
  if (!scene.geometry) return {};

  const ScreenMesh mesh = scene.geometry->screen_mesh(state);
  const MouthInterior& mouth = scene.setup.mouth;
  const std::array<InteriorColours, 3> interior = {interior_colours(mouth, &YuvColour::y, mesh.interior),
                                                   interior_colours(mouth, &YuvColour::u, {}),
                                                   interior_colours(mouth, &YuvColour::v, {})};
  const auto layer = [&](PlaneScale scale, std::size_t first, std::size_t count) {
    const SampleArea whole{0, 0, targets[first].width, targets[first].height};
    return Layer{std::span(textures).subspan(first, count),
                 {scale, std::span(targets).subspan(first, count), whole},
                 std::span(interior).subspan(first, count)};
  };
  const std::array<Layer, 2> layers = {layer(PlaneScale::kLuma, 0, 1), layer(PlaneScale::kChroma, 1, 2)};
  draw_surround(scene.geometry->surround().cells(), mesh, pattern.texture, layers);
  draw_head(mesh, pattern.texture, layers[0], luma_depth_);
  draw_head(mesh, pattern.texture, layers[1], chroma_depth_);
  return {};
}

Result<void> Renderer::render(const Scene& scene, const State& state, Picture& out) {
  if (auto checked = check(scene); !checked) return checked;
  const Picture& pattern = scene.patterns.front().picture;
  if (out.width() != pattern.width() || out.height() != pattern.height())
    out = Picture(pattern.width(), pattern.height());
  return render(scene, state, PictureView(out));
}

}  // namespace fbs
