// A textured triangle whose quantities all fit 32 bits, as nearly all do, for the kernels of
// triangle_kernels.h. Integers only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "decoder/raster/rasteriser.h"
#include "decoder/raster/run_walker.h"

namespace fbs {

/// The texture plus still sources, which show the samples of a picture in place.
inline constexpr std::size_t kMaxShortSources = 3;

/// A quantity that is linear over the triangle.
struct ShortGradient {
  std::int32_t first;   ///< at the first sample of ShortTriangle's box
  std::int32_t dx, dy;  ///< per sample
};

struct ShortTriangle {
  RunWalker runs;      ///< from the first row of the box on
  SampleArea box;      ///< contains all samples; not empty
  ShortGradient u, v;  ///< positions in the texture, 2^-16 sample; all lie within it
  ShortGradient depth;
  ShortGradient offset, gain;  ///< of the light, as in light_row()
  bool has_light = false;
  /// Weights of the texture and of the sources blended with it, except the last, which gets the remainder; in
  /// 2^-16 of 1 / kWeightOne.
  std::array<ShortGradient, kMaxShortSources - 1> weight;
};

/// Columns to the right of each position that a kernel may read, and rows below it.
inline constexpr int kReadColumns = 16, kReadRows = 4;

/// @param sources  the texture first. 1..kMaxTriangleSources
/// @return none where the triangle is too large, its texture lies at the border, or there is more to draw
/// than the above: draw_triangle() then does it by other means
[[nodiscard]] std::optional<ShortTriangle> shorten(const TriangleSetup& setup, const ScreenTriangle& triangle,
                                                   std::span<const TextureSource> sources,
                                                   const RasterTarget& target);

}  // namespace fbs
