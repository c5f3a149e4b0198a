// Makes patterns of reduced size.
#pragma once

#include "common/picture.h"

namespace fbs {

/// Halves a plane so that upscaled() of the result comes near it.
/// @return (width + 1) / 2 by (height + 1) / 2 samples
[[nodiscard]] Plane downscaled(const Plane& full);

/// The same for each plane.
[[nodiscard]] Picture downscaled(const Picture& full);

}  // namespace fbs
