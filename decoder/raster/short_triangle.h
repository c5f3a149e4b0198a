// A triangle drawn from one texture of which all quantities fit into 32 bits, as nearly all do: what the
// kernels of triangle_kernels.h draw. Integers only.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "decoder/raster/rasteriser.h"
#include "decoder/raster/run_walker.h"

namespace fbs {

/// A quantity that is linear over the triangle.
struct ShortGradient {
  std::int32_t first;   ///< at the first sample of ShortTriangle's box
  std::int32_t dx, dy;  ///< per sample
};

struct ShortTriangle {
  RunWalker runs;      ///< from the first row of the box on
  SampleArea box;      ///< all samples are in it; not empty
  ShortGradient u, v;  ///< places in the texture, 2^-16 sample; all lie within it
  ShortGradient depth;
  ShortGradient offset, gain;  ///< of the light, as light_row() has it
  bool has_light;
};

/// Columns beyond the left one of each place that a kernel may read, and rows below it.
inline constexpr int kReadColumns = 16, kReadRows = 4;

/// @param source  without an interior to be mixed nor light to be taken back
/// @return none where the triangle is too large, or its texture lies at the border: draw_triangle() draws it.
[[nodiscard]] std::optional<ShortTriangle> shorten(const TriangleSetup& setup, const ScreenTriangle& triangle,
                                                   const TextureSource& source, const RasterTarget& target);

}  // namespace fbs
