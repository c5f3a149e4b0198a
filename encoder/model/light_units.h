// Units of light in State. SPEC 10.11.
#pragma once

namespace fbs {

/// 1/16 grey levels, the unit of State::light and State::interior, per grey level.
inline constexpr double kLightUnitsPerLevel = 16;

inline constexpr double kGainLevels = 64;         ///< from 128, at which the gain of the light is given
inline constexpr double kLeastGainFactor = 0.25;  ///< lower bound when light is removed

}  // namespace fbs
