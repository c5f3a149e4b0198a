// Enlarges patterns of reduced size, in integers. SPEC 4.4.
#pragma once

#include <array>

#include "common/picture.h"

namespace fbs {

/// Lanczos of six taps at a quarter of a sample. Each reduced sample lies at the centre of the 2 x 2 samples
/// that it stands for, so that each of these is a quarter of the reduced spacing away from it:
///
///     full      0   1   2   3   4   5      an odd sample, say 3, weighs the reduced samples -1..4 by these
///     taps, reduced     0       1       2        an even one, say 2, the samples 3..-2: nearest + 2 - k
inline constexpr std::array<int, 6> kUpscaleTaps{4, -17, 114, 35, -9, 1};
inline constexpr int kUpscaleTapsLog2 = 7;  ///< the taps add up to 128
inline constexpr int kUpscaleNearestTap = 2;

/// Doubles a plane: taps in both directions, rounded once, samples outside taken from the border.
/// @param reduced        (width + 1) / 2 by (height + 1) / 2 samples
/// @param width, height  of the result, samples, at least 1
[[nodiscard]] Plane upscaled(const Plane& reduced, int width, int height);

/// The same for each plane.
/// @param reduced        a picture of (width + 1) / 2 by (height + 1) / 2 pixels
/// @param width, height  of the result, pixels
[[nodiscard]] Picture upscaled(const Picture& reduced, int width, int height);

}  // namespace fbs
