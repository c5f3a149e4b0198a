#include "encoder/blend/source_samples.h"

#include <algorithm>
#include <cmath>

#include "decoder/head/head_projection.h"

namespace fbs {
namespace {

float bilinear(const ReducedPlane& plane, float u, float v) {
  u = std::clamp(u, 0.0F, static_cast<float>(plane.width - 1));
  v = std::clamp(v, 0.0F, static_cast<float>(plane.height - 1));
  const int x = std::min(static_cast<int>(u), plane.width - 2), y = std::min(static_cast<int>(v), plane.height - 2);
  const float fx = u - static_cast<float>(x), fy = v - static_cast<float>(y);
  const std::uint8_t* a = plane.row(y) + x;
  const std::uint8_t* b = a + plane.width;
  const float top = static_cast<float>(a[0]) + fx * static_cast<float>(a[1] - a[0]);
  const float bottom = static_cast<float>(b[0]) + fx * static_cast<float>(b[1] - b[0]);
  return top + fy * (bottom - top);
}

}  // namespace

ReducedPlane reduce(const Plane& plane, int reduction) {
  ReducedPlane out{plane.width >> reduction, plane.height >> reduction, {}};
  out.samples.resize(static_cast<std::size_t>(out.width) * out.height);
  const int n = 1 << reduction, half = n * n / 2;
  std::vector<int> sum(out.width);
  for (int y = 0; y < out.height; ++y) {
    std::fill(sum.begin(), sum.end(), half);
    for (int i = 0; i < n; ++i) {
      const std::uint8_t* row = plane.row(y * n + i);
      for (int x = 0; x < out.width; ++x)
        for (int k = 0; k < n; ++k) sum[x] += row[x * n + k];
    }
    for (int x = 0; x < out.width; ++x)
      out.samples[static_cast<std::size_t>(y) * out.width + x] = static_cast<std::uint8_t>(sum[x] >> (2 * reduction));
  }
  return out;
}

SourceSampler::SourceSampler(const VisibleSurface& surface, const ScreenMesh& mesh, const ReducedPattern& pattern,
                             bool still, int reduction)
    : surface_(surface),
      mesh_(mesh),
      pattern_(pattern),
      still_(still),
      to_samples_(1.0F / static_cast<float>(1 << (kScreenOneLog2 + reduction))) {}

void SourceSampler::sample(const SurfaceRun& run, std::int16_t* out) const {
  if (still_) {
    const std::uint8_t* from = pattern_.luma.row(run.row) + run.first;
    std::copy(from, from + run.count, out);
    return;
  }
  const SurfaceTriangle& t = surface_.triangles()[run.triangle];
  const auto& texture = t.head ? pattern_.texture->head : pattern_.texture->surround;
  const glm::vec2 p0 = glm::vec2(texture[t.corners[0]]) * to_samples_ - glm::vec2(0.5F),
                  p1 = glm::vec2(texture[t.corners[1]] - texture[t.corners[0]]) * to_samples_,
                  p2 = glm::vec2(texture[t.corners[2]] - texture[t.corners[0]]) * to_samples_;
  const Barycentric& b = surface_.barycentric(run.triangle);
  const glm::vec2 first = b.at(static_cast<float>(run.first), static_cast<float>(run.row));
  glm::vec2 at = p0 + first.x * p1 + first.y * p2;
  const glm::vec2 step = b.per_column.x * p1 + b.per_column.y * p2;

  // Light, as an offset and a gain that are linear over the triangle.
  float offset = 0, offset_step = 0, gain = 0;
  if (t.head && !(mesh_.light.empty() && pattern_.texture->light.empty())) {
    const auto light = [&](std::size_t i) {
      const std::uint16_t v = t.corners[i];
      const auto of = [&](const std::vector<VertexLight>& l) { return l.empty() || v >= l.size() ? VertexLight{} : l[v]; };
      const VertexLight now = of(mesh_.light), seen = of(pattern_.texture->light);
      return glm::vec2(now.offset - seen.offset, now.gain - seen.gain) / 16.0F;
    };
    const glm::vec2 l0 = light(0), l1 = light(1) - l0, l2 = light(2) - l0;
    offset = l0.x + first.x * l1.x + first.y * l2.x;
    offset_step = b.per_column.x * l1.x + b.per_column.y * l2.x;
    gain = (l0.y + first.x * l1.y + first.y * l2.y) / 64.0F;
  }
  for (int i = 0; i < run.count; ++i, at += step, offset += offset_step) {
    const float v = bilinear(pattern_.luma, at.x, at.y);
    out[i] = static_cast<std::int16_t>(std::lround(v + offset + gain * (v - 128.0F)));
  }
}

}  // namespace fbs
