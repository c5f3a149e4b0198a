#include "decoder/atlas/head_atlas.h"

#include "decoder/raster/rasteriser.h"

namespace fbs {

void draw_atlas(const AtlasLayout& layout, const std::array<ConstPlaneView, 3>& planes,
                std::span<const glm::ivec2> positions, const std::vector<VertexLight>& light,
                HeadAtlas& out) {
  if (out.width() != layout.width || out.height() != layout.height)
    out = HeadAtlas(layout.width, layout.height);
  std::vector<glm::ivec2> seen(positions.begin(), positions.end());
  layout.add_skirt(seen);
  const std::array<PlaneView, 1> luma{out.y};
  const std::array<PlaneView, 2> chroma{out.u, out.v};
  const std::span<const ConstPlaneView> all(planes);
  for (const MeshTriangle& triangle : layout.triangles) {
    ScreenTriangle at;
    TextureSource source{all.first(1), {}, {}};
    Light seen_light;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto point = static_cast<std::size_t>(triangle[k]);
      at[k] = {layout.points[point]};
      source.corners[k] = seen[point];
      if (point >= light.size()) continue;
      seen_light.offset[k] = light[point].offset;
      seen_light.gain[k] = light[point].gain;
    }
    if (!light.empty()) source.finish.light_before = &seen_light;
    draw_triangle(at, {&source, 1}, {PlaneScale::kLuma, luma, {0, 0, out.y.width, out.y.height}});
    source.planes = all.last(2);
    source.finish = {};
    draw_triangle(at, {&source, 1}, {PlaneScale::kChroma, chroma, {0, 0, out.u.width, out.u.height}});
  }
}

}  // namespace fbs
