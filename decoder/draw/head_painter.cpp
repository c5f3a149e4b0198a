#include "decoder/draw/head_painter.h"

#include <algorithm>

#include "decoder/head/head_projection.h"
#include "decoder/head/mouth_interior.h"

namespace fbs {
namespace {

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

}  // namespace

HeadPainter::HeadPainter(const Drawing& drawing, PlaneScale scale, DepthPlane& depth)
    : d_(drawing), scale_(scale) {
  const auto planes = planes_of_scale(drawing.target, scale);
  const int width = planes[0].width, height = planes[0].height;
  target_ = {scale, planes, area_of_head(drawing.mesh, scale, drawing.area(scale)), &depth};
  if (!target_.area.empty()) depth.reset(width, height, target_.area);
}

void HeadPainter::draw() {
  if (target_.area.empty()) return;
  for (const HeadTriangle& triangle : head_mesh().triangles) draw(triangle);
}

void HeadPainter::draw(const HeadTriangle& triangle) {
  const auto corners = [&](const auto& at) {
    return std::array{glm::ivec2(at[triangle[0]]), glm::ivec2(at[triangle[1]]), glm::ivec2(at[triangle[2]])};
  };
  sources_.collect(d_, d_.blend.head, {triangle[0], triangle[1], triangle[2]},
                   [&](const DrawnSource& source) {
                     return source.texture == nullptr ? corners(d_.mesh.head) : corners(source.texture->head);
                   });
  sources_.set_scale(scale_);
  const bool is_interior = std::all_of(triangle.begin(), triangle.end(), is_inner_lip);
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (sources_.drawn(i).texture == nullptr) continue;
    if (scale_ == PlaneScale::kLuma) add_light(triangle, i);
    if (is_interior) add_interior(triangle, i);
  }
  ScreenTriangle t;
  for (std::size_t i = 0; i < t.size(); ++i) t[i] = {d_.mesh.head[triangle[i]], d_.mesh.head[triangle[i]].z};
  draw_triangle(t, sources_.all(), target_);
}

/// The light that the picture has and the pattern has not.
void HeadPainter::add_light(const HeadTriangle& triangle, std::size_t i) {
  const TextureMesh& texture = *sources_.drawn(i).texture;
  if (d_.mesh.light.empty() && texture.light.empty()) return;
  const auto at = [](const std::vector<VertexLight>& light, std::size_t v) {
    return light.empty() ? VertexLight{} : light[v];
  };
  for (std::size_t k = 0; k < triangle.size(); ++k) {
    const VertexLight now = at(d_.mesh.light, triangle[k]), seen = at(texture.light, triangle[k]);
    light_[i].offset[k] = now.offset - seen.offset;
    light_[i].gain[k] = now.gain - seen.gain;
  }
  sources_[i].finish.light = &light_[i];
}

/// The mouth's interior, as far as the lips have parted since the pattern was seen.
void HeadPainter::add_interior(const HeadTriangle& triangle, std::size_t i) {
  const std::int32_t opacity = interior_opacity(d_.mesh.mouth_gap, sources_.drawn(i).texture->mouth_gap);
  if (opacity == 0) return;
  interior_[i] = {{}, opacity, planes_of_scale(d_.interior, scale_)};
  std::transform(triangle.begin(), triangle.end(), interior_[i].ramp.begin(), mouth_ramp);
  sources_[i].finish.interior = &interior_[i];
}

}  // namespace fbs
