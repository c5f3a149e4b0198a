// The decoder's picture at the sample points: Renderer's arithmetic in continuous numbers. SPEC 10.
#pragma once

#include <array>

#include "bitstream/syntax.h"
#include "encoder/fit/pattern_samples.h"

namespace fbs {

/// Luma added by one grey level of each number of the light.
/// @param light  SamplePoints::light()  @param luma  of the pattern
[[nodiscard]] std::array<double, kLightCount> light_basis(std::array<double, kLightCount> light, double luma);

/// Colour added to the mouth interior by one grey level of each of its numbers.
/// @param ramp  0 at the upper lip to 1 at the lower
[[nodiscard]] std::array<double, kInteriorCount> interior_basis(double ramp);

/// How much of the mouth's colours shows at a place of the ramp, 0..1: they fade towards the lips.
[[nodiscard]] double interior_cover(double ramp);

/// One state drawn from one pattern. Borrows points and pattern.
class Appearance {
 public:
  Appearance(const SamplePoints& points, const PatternSamples& pattern, const MouthInterior& mouth,
             const Fit& fit, const HeadVertices& vertices);

  /// Luma; negative where the pattern does not reach.
  [[nodiscard]] double at(std::size_t point, int level) const;

  /// Share of the mouth interior in the picture, 0..1: already in the pattern, or added.
  [[nodiscard]] double interior_share(std::size_t point) const {
    const double ramp = points_.mouth_ramp(point), shade = shade_ * interior_cover(ramp) / kShadeOne;
    return ramp < 0 ? 0 : shade + (1 - shade) * pattern_.interior_opacity();
  }

 private:
  static constexpr double kShadeOne = 256;  ///< unit of interior_opacity()

  const SamplePoints& points_;
  const PatternSamples& pattern_;
  std::array<double, kLightCount> light_;        ///< of the state
  std::array<double, kInteriorCount> interior_;  ///< luma at upper lip, half way and lower lip
  std::array<double, kInteriorCount> added_;     ///< the state's part of interior_
  std::int32_t shade_;
};

}  // namespace fbs
