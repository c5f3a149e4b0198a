// Distortion of each blend mode in each region, picture by picture.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "common/picture.h"
#include "decoder/scene/scene.h"
#include "encoder/blend/source_samples.h"

namespace fbs {

/// The error of a mode that draws a part of the face without motion from where it does not lie.
inline constexpr double kTorn = 1e30;

/// Squared luma error of a region in each mode, in samples of the full picture, or kTorn.
using ModeErrors = std::array<std::array<double, kBlendModeCount>, kRegionCount>;

/// Works on decoded patterns at a reduced size. Several threads may use one object.
class BlendErrors {
 public:
  /// @param scene      must outlive the object, with everything it refers to
  /// @param reduction  log2
  BlendErrors(const BlendScene& scene, int reduction);

  /// @param source     the picture
  /// @param available  indices of the usable patterns
  [[nodiscard]] ModeErrors errors(const Plane& source, const State& state,
                                  std::span<const std::size_t> available) const;

 private:
  /// The luma of a pattern, reduced when it is first needed: of many, few show in a picture.
  [[nodiscard]] const ReducedPlane& luma_of(std::size_t pattern) const;

  struct Reduced {
    std::once_flag once;
    ReducedPlane luma;
  };
  BlendScene scene_;
  int reduction_;
  std::unique_ptr<Reduced[]> reduced_;  ///< of each pattern
};

}  // namespace fbs
