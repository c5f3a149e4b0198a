// Enlarges patterns of reduced size, in integers. SPEC 4.4.
#pragma once

#include "common/picture.h"

namespace fbs {

/// Doubles a plane. Each reduced sample lies at the centre of the 2 x 2 samples that it stands for, so that a
/// sample of the result lies a quarter of the reduced sample spacing from the nearest one.
/// @param reduced        (width + 1) / 2 by (height + 1) / 2 samples
/// @param width, height  of the result, samples, at least 1
[[nodiscard]] Plane upscaled(const Plane& reduced, int width, int height);

/// The same for each plane.
/// @param reduced        a picture of (width + 1) / 2 by (height + 1) / 2 pixels
/// @param width, height  of the result, pixels
[[nodiscard]] Picture upscaled(const Picture& reduced, int width, int height);

}  // namespace fbs
