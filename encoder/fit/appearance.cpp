#include "encoder/fit/appearance.h"

#include <algorithm>
#include <cmath>

#include "decoder/head/mouth_interior.h"

namespace fbs {

std::array<double, kLightCount> light_basis(std::array<double, kLightCount> light, double luma) {
  light[kLightGain] = (luma - 128) / kGainLevels;
  return light;
}

std::array<double, kInteriorCount> interior_basis(double ramp) {
  return {std::max(0.0, 1 - 2 * ramp), 1 - std::abs(2 * ramp - 1), std::max(0.0, 2 * ramp - 1)};
}

double interior_cover(double ramp) {
  constexpr double kFade = kInteriorFade / 256.0;
  return std::min(1.0, std::min(ramp, 1 - ramp) / kFade);
}

Appearance::Appearance(const SamplePoints& points, const PatternSamples& pattern, const MouthInterior& mouth,
                       const Fit& fit, const HeadVertices& vertices)
    : points_(points),
      pattern_(pattern),
      light_(fit.light),
      shade_(interior_opacity(mouth_gap(vertices), pattern.mouth_gap())) {
  added_ = fit.interior;
  constexpr double kPerGreyLevel = 16;  // units of interior_base()
  const auto base = interior_base(mouth, &YuvColour::y);
  for (std::size_t i = 0; i < kInteriorCount; ++i) interior_[i] = base[i] / kPerGreyLevel + fit.interior[i];
}

double Appearance::at(std::size_t point, int level) const {
  auto value = static_cast<double>(pattern_.luma(level, point));
  if (value < 0) return value;
  const auto light = light_basis(points_.light(point), value);
  for (std::size_t i = 0; i < kLightCount; ++i) value += light_[i] * light[i];
  value = std::clamp(value, 0.0, 255.0);
  const double ramp = points_.mouth_ramp(point);
  if (ramp < 0 || (shade_ == 0 && pattern_.interior_opacity() == 0)) return value;
  const auto shares = interior_basis(ramp);
  double inside = 0, brighter = 0;
  for (std::size_t i = 0; i < kInteriorCount; ++i) {
    inside += shares[i] * interior_[i];
    brighter += shares[i] * (added_[i] - pattern_.interior()[i]);
  }
  value += pattern_.interior_opacity() * brighter;
  const double shade = shade_ * interior_cover(ramp);
  return (value * (kShadeOne - shade) + inside * shade) / kShadeOne;
}

}  // namespace fbs
