#include "decoder/draw/head_painter.h"

#include <algorithm>

#include "decoder/draw/silhouette.h"
#include "decoder/head/head_projection.h"

namespace fbs {

static_assert(kMeshWeightOne == kWeightOne);
static_assert(kMaxTriangleSources ==
              kRegionCount * kMaxRegionSources);  // the atlas counts for one warped source

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
auto at_corners(const HeadTriangle& triangle, At&& at) {
  return std::array{at(triangle[0]), at(triangle[1]), at(triangle[2])};
}

}  // namespace

HeadPainter::HeadPainter(const Drawing& drawing, const HeadTexture& texture, PlaneScale scale,
                         DepthPlane& depth)
    : d_(drawing), texture_(texture), scale_(scale) {
  const auto planes = planes_of_scale(drawing.target, scale);
  const int width = planes[0].width, height = planes[0].height;
  target_ = {scale, planes, area_of_head(drawing.mesh, scale, drawing.area(scale)), &depth};
  depth.reset(width, height, target_.area);
}

void HeadPainter::draw() {
  if (target_.area.empty()) return;
  for (const HeadTriangle& triangle : texture_.geometry.head_mesh().triangles) draw(triangle);
}

void HeadPainter::soften() {
  if (!target_.area.empty())
    soften_silhouettes(d_.mesh, texture_.geometry.head_mesh(), texture_.weights, target_);
}

void HeadPainter::draw(const HeadTriangle& triangle) {
  const PointWeights& weights = texture_.weights.screen;
  const auto weight_of = [&](std::size_t source) {
    return at_corners(triangle, [&](std::size_t v) { return weights.at(v)[source]; });
  };
  const auto shows = [](const std::array<std::int32_t, 3>& weight) {
    return (weight[0] | weight[1] | weight[2]) != 0;
  };
  const auto on_screen = at_corners(triangle, [&](std::size_t v) { return glm::ivec2(d_.mesh.head[v]); });

  sources_.clear();
  Light light;
  if (const auto weight = weight_of(0); shows(weight)) {
    sources_.push_back({planes_of_scale(texture_.atlas, scale_),
                        at_corners(triangle, [&](std::size_t v) { return texture_.layout.points[v]; }),
                        {},
                        weight});
    Finish& finish = sources_.back().finish;
    if (scale_ == PlaneScale::kLuma && !d_.mesh.light.empty()) {
      light = {at_corners(triangle, [&](std::size_t v) { return d_.mesh.light[v].offset; }),
               at_corners(triangle, [&](std::size_t v) { return d_.mesh.light[v].gain; })};
      finish.light = &light;
    }
  }
  for (std::size_t k = 0; k < texture_.weights.still.size(); ++k)
    if (const auto weight = weight_of(k + 1); shows(weight))
      sources_.push_back(
          {planes_of_scale(d_.sources[texture_.weights.still[k]].planes, scale_), on_screen, {}, weight});
  ScreenTriangle t;
  for (std::size_t k = 0; k < t.size(); ++k) t[k] = {on_screen[k], d_.mesh.head[triangle[k]].z};
  draw_triangle(t, sources_, target_);
}

}  // namespace fbs
