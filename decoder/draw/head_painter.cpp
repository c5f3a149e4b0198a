#include "decoder/draw/head_painter.h"

#include <algorithm>

#include "decoder/draw/silhouette.h"
#include "decoder/head/head_projection.h"

namespace fbs {

static_assert(kMeshWeightOne == kWeightOne);

namespace {

/// Samples that the head can cover, and those round them that are softened, within `limit`.
SampleArea area_of_head(const ScreenMesh& mesh, PlaneScale scale, const SampleArea& limit) {
  glm::ivec2 low(kMaxScreen), high(-kMaxScreen);
  for (const glm::ivec3& p : mesh.head) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const glm::ivec2 round(kMaxSoftened << static_cast<int>(scale));
  return samples_in_box(low - round, high + round, scale, limit);
}

/// A value for each corner of a triangle.
template <class At>
auto at_corners(const MeshTriangle& triangle, At&& at) {
  const auto of = [&](std::size_t k) { return at(static_cast<std::size_t>(triangle[k])); };
  return std::array{of(0), of(1), of(2)};
}

}  // namespace

void HeadPainter::draw(const std::array<ConstPlaneView, 3>& atlas) {
  std::array<std::vector<ConstPlaneView>, 2> still;
  const auto start = [&](PlaneScale scale, std::size_t k) {
    for (const std::size_t source : weights_.still) {
      const auto planes = planes_of_scale(d_.sources[source].planes, scale);
      still[k].insert(still[k].end(), planes.begin(), planes.end());
    }
    const bool is_lit = scale == PlaneScale::kLuma && !d_.mesh.light.empty();
    raster_[k].start(scale, area_of_head(d_.mesh, scale, d_.area(scale)),
                     {planes_of_scale(atlas, scale), is_lit ? LightUse::kAdded : LightUse::kNone, still[k],
                      planes_of_scale(d_.target, scale)});
  };
  start(PlaneScale::kLuma, 0);
  start(PlaneScale::kChroma, 1);
  const AtlasLayout& layout = geometry_.atlas_layout();
  for (const MeshTriangle& triangle :
       std::span(layout.triangles).first(geometry_.head_mesh().triangles.size())) {
    const ScreenTriangle t = at_corners(triangle, [&](std::size_t v) {
      return ScreenVertex{glm::ivec2(d_.mesh.head[v]), d_.mesh.head[v].z};
    });
    if (!faces_viewer(t)) continue;
    const TriangleLook look = look_of(triangle, layout);
    for (Rasteriser& raster : raster_) raster.add(t, look);
  }
  for (Rasteriser& raster : raster_) raster.draw();
}

TriangleLook HeadPainter::look_of(const MeshTriangle& triangle, const AtlasLayout& layout) {
  const PointWeights& weights = weights_.screen;
  sources_.clear();
  for (std::size_t k = 0; k < weights.sources; ++k)
    if (const auto weight = at_corners(triangle, [&](std::size_t v) { return weights.at(v)[k]; });
        (weight[0] | weight[1] | weight[2]) != 0)
      sources_.push_back({k, weight});
  TriangleLook out{at_corners(triangle, [&](std::size_t v) { return layout.points[v]; }), {}, {}, sources_};
  if (sources_.size() == 1 && sources_[0].source == 0) out.sources = {};
  if (!d_.mesh.light.empty()) {
    out.offset = at_corners(triangle, [&](std::size_t v) { return d_.mesh.light[v].offset; });
    out.gain = at_corners(triangle, [&](std::size_t v) { return d_.mesh.light[v].gain; });
  }
  return out;
}

void HeadPainter::soften(PlaneScale scale) const {
  const DepthPlane& depth = raster_[scale == PlaneScale::kLuma ? 0 : 1].depth();
  if (!depth.area.empty())
    soften_silhouettes(d_.mesh, geometry_.head_mesh(), weights_, scale, depth,
                       planes_of_scale(d_.target, scale));
}

}  // namespace fbs
