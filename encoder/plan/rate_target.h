// What the settings ask of rate control.
#pragma once

#include <cstddef>

#include "encoder/plan/rate_control.h"
#include "encoder/settings.h"

namespace fbs {

/// Approximate startup besides geometry and pattern: setup, surround, packet headers.
inline constexpr std::size_t kOtherStartupBytes = 160;

[[nodiscard]] inline RateTarget rate_target(const EncoderSettings& settings, double eye_distance_px) {
  return {settings.quality, settings.bitrate, settings.seconds, settings.motion_bitrate, eye_distance_px};
}

}  // namespace fbs
