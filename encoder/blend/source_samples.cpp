#include "encoder/blend/source_samples.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "decoder/field/padded_plane.h"
#include "decoder/head/head_projection.h"
#include "decoder/head/mouth_interior.h"
#include "encoder/model/light_units.h"

namespace fbs {
namespace {

constexpr auto kLevelsPerLightUnit = static_cast<float>(1 / kLightUnitsPerLevel);

VertexLight light_of(const std::vector<VertexLight>& light, std::size_t vertex) {
  return light.empty() ? VertexLight{} : light[vertex];
}

/// Replaces the pattern's light by the picture's: SPEC 10.11.
void add_light(const ScreenMesh& mesh, const TextureMesh& texture, const SurfaceTriangle& t,
               const Barycentric& b, TriangleLight& out) {
  if (mesh.light.empty() && texture.light.empty()) return;
  glm::vec3 offset, gain;
  for (int i = 0; i < 3; ++i) {
    const std::uint16_t corner = t.corners[static_cast<std::size_t>(i)];
    const VertexLight now = light_of(mesh.light, corner), seen = light_of(texture.light, corner);
    constexpr auto kPerLevel = static_cast<float>(1 / (kLightUnitsPerLevel * kGainLevels));
    const float ratio =
        (1 + kPerLevel * static_cast<float>(now.gain)) /
        std::max(1 + kPerLevel * static_cast<float>(seen.gain), static_cast<float>(kLeastGainFactor));
    offset[i] =
        kLevelsPerLightUnit * (static_cast<float>(now.offset) - ratio * static_cast<float>(seen.offset));
    gain[i] = ratio - 1;
  }
  out.offset = between(b, offset);
  out.gain = between(b, gain);
}

void add_interior(const PictureMesh& picture, const TextureMesh& texture, const SurfaceTriangle& t,
                  TriangleLight& out) {
  if (!is_mouth(generic_head(), t.corners)) return;
  const std::int32_t opacity = interior_opacity(picture.mesh.mouth_gap, texture.mouth_gap);
  if (opacity == 0) return;
  const auto colours = interior_colours(picture.mouth, picture.mesh.interior);
  std::int32_t ramp = 0;
  for (const std::uint16_t v : t.corners) ramp += mouth_ramp(generic_head(), v);
  const float at =
      2.0F * static_cast<float>(ramp) / (3.0F * kMouthRampEnd);  // 0 upper lip, 1 half way, 2 lower
  const auto upper = static_cast<std::size_t>(at < 1 ? 0 : 1);
  const float share = at - static_cast<float>(upper);
  constexpr float kMeanCover = 1 - kInteriorFade / 256.0F;
  out.opacity = kMeanCover * static_cast<float>(opacity) / kInteriorOpaque;
  for (std::size_t i = 0; i < colours.size(); ++i)
    out.interior[i] = (1 - share) * colours[i][upper] + share * colours[i][upper + 1];
}

/// Whether the light changes anything.
bool shows(const TriangleLight& light) {
  const auto is_zero = [](const TriangleValue& v) {
    return v.origin == 0 && v.per_column == 0 && v.per_row == 0;
  };
  return light.opacity != 0 || !is_zero(light.offset) || !is_zero(light.gain);
}

/// Interpolates the samples of a footprint.
/// @param a      the upper left sample
/// @param width  of the plane
float mixed(const float* a, int width, float fx, float fy) {
  const float* b = a + width;
  const float top = a[0] + fx * (a[1] - a[0]), bottom = b[0] + fx * (b[1] - b[0]);
  return top + fy * (bottom - top);
}

/// Whether the surround lies as in the pattern: the decoder then shows the pattern's own samples.
bool is_at_rest(const SurfaceTriangle& t, const ScreenMesh& mesh, const TextureMesh& texture) {
  return !t.head && std::ranges::all_of(
                        t.corners, [&](std::uint16_t k) { return mesh.surround[k] == texture.surround[k]; });
}

/// @tparam Sum  holds the sum of a square
template <class Sum>
ReducedPlane reduced_by_sums(const Plane& plane, int reduction) {
  ReducedPlane out{plane.width >> reduction, plane.height >> reduction, {}};
  out.samples.resize(static_cast<std::size_t>(out.width) * out.height);
  const int n = 1 << reduction;
  const float scale = 1.0F / static_cast<float>(n * n);
  // First columns, then pairs: loops that the compiler makes vectors of.
  std::vector<Sum> sums(static_cast<std::size_t>(out.width) << reduction), pairs(sums.size() / 2);
  for (int y = 0; y < out.height; ++y) {
    std::fill(sums.begin(), sums.end(), Sum{0});
    for (int i = 0; i < n; ++i) {
      const std::uint8_t* row = plane.row(y * n + i);
      for (std::size_t x = 0; x < sums.size(); ++x) sums[x] = static_cast<Sum>(sums[x] + row[x]);
    }
    Sum *from = sums.data(), *half = pairs.data();
    for (std::size_t width = sums.size() / 2; width >= static_cast<std::size_t>(out.width) && n > 1;
         width /= 2) {
      for (std::size_t x = 0; x < width; ++x) half[x] = static_cast<Sum>(from[2 * x] + from[2 * x + 1]);
      std::swap(from, half);
    }
    float* to = out.row(y);
    for (int x = 0; x < out.width; ++x) to[x] = scale * static_cast<float>(from[x]);
  }
  return out;
}

}  // namespace

ReducedPlane reduce(const Plane& plane, int reduction) {
  constexpr int kMaxShort = 4;  // log2; sums of more samples need more bits
  return reduction > kMaxShort ? reduced_by_sums<std::uint32_t>(plane, reduction)
                               : reduced_by_sums<std::uint16_t>(plane, reduction);
}

float border_inset(int reduction) {
  return std::max((static_cast<float>(kLumaInset) + 0.5F) / static_cast<float>(1 << reduction) - 0.5F, 0.0F);
}

TriangleValue between(const Barycentric& b, glm::vec3 corners) {
  const glm::vec2 d(corners[1] - corners[0], corners[2] - corners[0]);
  return {corners[0] + glm::dot(b.origin, d), glm::dot(b.per_column, d), glm::dot(b.per_row, d)};
}

TriangleSource triangle_source(const PictureMesh& picture, std::uint32_t triangle, const TextureMesh& texture,
                               bool still) {
  TriangleSource out;
  const SurfaceTriangle& t = picture.surface.triangles()[triangle];
  if (still || is_at_rest(t, picture.mesh, texture)) return out;
  const Barycentric& b = picture.surface.barycentric(triangle);
  const auto& points = t.head ? texture.head : texture.surround;
  const float to_samples = 1.0F / static_cast<float>(1 << (kScreenOneLog2 + picture.reduction));
  glm::vec3 u, v;
  for (int i = 0; i < 3; ++i) {
    const glm::ivec2 at(points[t.corners[static_cast<std::size_t>(i)]]);
    u[i] = static_cast<float>(at.x) * to_samples - 0.5F;
    v[i] = static_cast<float>(at.y) * to_samples - 0.5F;
  }
  out.place = {between(b, u), between(b, v)};
  if (t.head) {
    TriangleLight light;
    add_light(picture.mesh, texture, t, b, light);
    add_interior(picture, texture, t, light);
    if (shows(light)) out.light = light;
  } else {
    out.inset = border_inset(picture.reduction);
  }
  return out;
}

float bilinear(const ReducedPlane& plane, float u, float v) {
  u = std::clamp(u, 0.0F, static_cast<float>(plane.width - 1));
  v = std::clamp(v, 0.0F, static_cast<float>(plane.height - 1));
  const int x = std::min(static_cast<int>(u), plane.width - 2),
            y = std::min(static_cast<int>(v), plane.height - 2);
  return mixed(plane.row(y) + x, plane.width, u - static_cast<float>(x), v - static_cast<float>(y));
}

}  // namespace fbs
