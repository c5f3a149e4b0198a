// What a source of a blend shows at the samples of a picture, at a reduced size: the renderer's warp in
// floating point.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "decoder/blend/picture_blend.h"
#include "decoder/scene.h"
#include "encoder/blend/visible_surface.h"

namespace fbs {

/// A plane at a reduced size.
struct ReducedPlane {
  int width = 0, height = 0;
  std::vector<std::uint8_t> samples;
  [[nodiscard]] const std::uint8_t* row(int y) const { return samples.data() + static_cast<std::ptrdiff_t>(y) * width; }
};

/// Means of squares of 2^reduction samples; what does not fill a square is dropped.
[[nodiscard]] ReducedPlane reduce(const Plane& plane, int reduction);

/// A pattern as textures are read from it.
struct ReducedPattern {
  const TextureMesh* texture;
  ReducedPlane luma;
};

/// Luma of one source along a run.
class SourceSampler {
 public:
  /// @param pattern  must outlive the object, as must the others
  /// @param still    not warped
  SourceSampler(const VisibleSurface& surface, const ScreenMesh& mesh, const ReducedPattern& pattern, bool still,
                int reduction);

  /// @param out  run.count samples
  void sample(const SurfaceRun& run, std::int16_t* out) const;

 private:
  const VisibleSurface& surface_;
  const ScreenMesh& mesh_;
  const ReducedPattern& pattern_;
  bool still_;
  float to_samples_;  ///< per 1/64 pixel
};

}  // namespace fbs
