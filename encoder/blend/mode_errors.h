// What each blend mode of each region costs in distortion, picture by picture.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/picture.h"
#include "decoder/scene/scene.h"
#include "encoder/blend/source_samples.h"

namespace fbs {

/// Squared luma error of a region in each mode, in samples of the full picture.
using ModeErrors = std::array<std::array<double, kBlendModeCount>, kRegionCount>;

/// Patterns as decoded, at a reduced size.
class BlendErrors {
 public:
  /// @param scene      what it refers to must outlive the object
  /// @param reduction  log2
  BlendErrors(const BlendScene& scene, int reduction);

  /// @param source     the picture
  /// @param available  indices of the patterns that can be used
  [[nodiscard]] ModeErrors errors(const Plane& source, const State& state,
                                  std::span<const std::size_t> available) const;

 private:
  BlendScene scene_;
  int reduction_;
  std::vector<ReducedPattern> reduced_;
};

}  // namespace fbs
