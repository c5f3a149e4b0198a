// The samples of a blend's source at the positions of a picture, at a reduced size: the renderer's warp in
// floating point.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "decoder/blend/picture_blend.h"
#include "decoder/scene/scene.h"
#include "encoder/blend/visible_surface.h"

namespace fbs {

/// Rounds a sample, which is never negative; lround takes several times as long.
[[nodiscard]] inline int rounded(float sample) {
  return static_cast<int>(sample + 0.5F);  // NOLINT(bugprone-incorrect-roundings)
}

/// A plane at a reduced size.
struct ReducedPlane {
  int width = 0, height = 0;
  std::vector<float> samples;
  [[nodiscard]] const float* row(int y) const {
    return samples.data() + static_cast<std::ptrdiff_t>(y) * width;
  }
  [[nodiscard]] float* row(int y) { return samples.data() + static_cast<std::ptrdiff_t>(y) * width; }
};

/// Means over squares of 2^reduction samples; incomplete squares are dropped.
[[nodiscard]] ReducedPlane reduce(const Plane& plane, int reduction);

/// The patterns and geometry that pictures are blended from.
struct BlendScene {
  const SceneGeometry& geometry;
  const MouthInterior& mouth;
  const PatternList& patterns;
};

/// A value that is linear along a run.
struct RunValue {
  float first = 0, step = 0;
};

/// A value that is linear over a triangle of the picture.
struct TriangleValue {
  float origin = 0, per_column = 0, per_row = 0;  ///< at sample (0, 0), and increments per sample

  [[nodiscard]] RunValue along(int row, int first) const {
    return {origin + static_cast<float>(first) * per_column + static_cast<float>(row) * per_row, per_column};
  }
};

/// @param corners  values there
[[nodiscard]] TriangleValue between(const Barycentric& b, glm::vec3 corners);

/// Where a run lies in a texture.
struct TexturePath {
  RunValue u, v;    ///< position, samples; integers lie on centres
  float inset = 0;  ///< border samples that repeat those inside
};

/// What light and mouth interior make of a texture's samples. Quantities that hardly change have one value.
struct TriangleLight {
  TriangleValue offset;  ///< of the light, grey levels
  TriangleValue gain;    ///< of the light, per grey level from 128; each run has its first sample's
  float opacity = 0;     ///< of the mouth interior, 0..1
  std::array<float, 3> interior{};  ///< the interior's Y, U, V; mean
};

/// Where a triangle lies in a texture: u and v of its samples.
struct TexturePlace {
  TriangleValue u, v;

  [[nodiscard]] TexturePath along(int row, int first, float inset) const {
    return {u.along(row, first), v.along(row, first), inset};
  }
};

/// How to sample a texture over a triangle.
struct TriangleSource {
  std::optional<TexturePlace> place{};  ///< nothing: the texture's own samples show
  std::optional<TriangleLight> light{};
  float inset = 0;  ///< TexturePath::inset
};

/// The mesh of a picture, with the inputs of its light and mouth.
struct PictureMesh {
  const VisibleSurface& surface;
  const ScreenMesh& mesh;
  const MouthInterior& mouth;
  int reduction;
};

/// TexturePath::inset of the surround: samples of a plane whose border repeats those inside (kLumaInset).
/// After much reduction, the outermost samples are mostly from inside.
[[nodiscard]] float border_inset(int reduction);

/// @param still  the texture is not warped
[[nodiscard]] TriangleSource triangle_source(const PictureMesh& picture, std::uint32_t triangle,
                                             const TextureMesh& texture, bool still);

/// Whether all samples that a run interpolates lie inside a plane of this size, even with rounding in the
/// increments added up along it.
[[nodiscard]] inline bool is_inside(const TexturePath& source, int count, glm::ivec2 size) {
  constexpr float kDrift = 0.25F;
  const auto within = [&](const RunValue& v, int samples) {
    const float end = v.first + v.step * static_cast<float>(count - 1);
    return std::min(v.first, end) >= source.inset &&
           std::max(v.first, end) < static_cast<float>(samples - 1) - source.inset - kDrift;
  };
  return within(source.u, size.x) && within(source.v, size.y);
}

/// Calls use(i, index of the upper left sample, fx, fy) for each sample i of a run, which interpolates four
/// samples of a plane of this size; fx and fy are the shares of the right and the lower ones. Positions
/// outside repeat the border.
template <class Use>
void for_each_footprint(const TexturePath& source, int count, glm::ivec2 size, Use&& use) {
  float u = source.u.first, v = source.v.first;
  const auto at = [&](int i, int column, int row, float x, float y) {
    use(i, row * size.x + column, x - static_cast<float>(column), y - static_cast<float>(row));
  };
  if (is_inside(source, count, size)) {
    for (int i = 0; i < count; ++i, u += source.u.step, v += source.v.step)
      at(i, static_cast<int>(u), static_cast<int>(v), u, v);
  } else {
    for (int i = 0; i < count; ++i, u += source.u.step, v += source.v.step) {
      const float x = std::clamp(u, source.inset, static_cast<float>(size.x - 1) - source.inset),
                  y = std::clamp(v, source.inset, static_cast<float>(size.y - 1) - source.inset);
      at(i, std::min(static_cast<int>(x), size.x - 2), std::min(static_cast<int>(y), size.y - 2), x, y);
    }
  }
}

/// Bilinear; positions outside repeat the border.
[[nodiscard]] float bilinear(const ReducedPlane& plane, float u, float v);

}  // namespace fbs
