// How State counts light. SPEC 10.11.
#pragma once

namespace fbs {

/// 1/16 grey levels, the unit of State::light and State::interior, per grey level.
inline constexpr double kLightUnitsPerLevel = 16;

inline constexpr double kGainLevels = 64;  ///< from 128: the gain of the light counts for so many grey levels
inline constexpr double kLeastGainFactor = 0.25;  ///< by which light is taken back

}  // namespace fbs
