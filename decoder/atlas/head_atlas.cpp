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
  Rasteriser raster;
  const auto draw = [&](PlaneScale scale, std::span<const ConstPlaneView> from,
                        std::span<const PlaneView> to) {
    const bool is_lit = scale == PlaneScale::kLuma && !light.empty();
    raster.start(scale, {0, 0, to[0].width, to[0].height},
                 {from, is_lit ? LightUse::kTakenBack : LightUse::kNone, {}, to});
    // All have the same depth, at which the first one stays: the last comes first.
    for (auto t = layout.triangles.rbegin(); t != layout.triangles.rend(); ++t) {
      ScreenTriangle at;
      TriangleLook look;
      for (std::size_t k = 0; k < at.size(); ++k) {
        const auto point = static_cast<std::size_t>((*t)[k]);
        at[k] = {layout.points[point]};
        look.corners[k] = seen[point];
        if (!is_lit || point >= light.size()) continue;
        look.offset[k] = light[point].offset;
        look.gain[k] = light[point].gain;
      }
      raster.add(at, look);
    }
    raster.draw();
  };
  const std::array<PlaneView, 3> to{out.y, out.u, out.v};
  draw(PlaneScale::kLuma, std::span(planes).first(1), std::span(to).first(1));
  draw(PlaneScale::kChroma, std::span(planes).last(2), std::span(to).last(2));
}

}  // namespace fbs
