// Whether patterns are better coded at half width and height.
#pragma once

#include <cstddef>

#include "encoder/patterns/pattern_trial.h"

namespace fbs {

/// Compares PSNR of the pictures and bytes of the patterns at both sizes.
/// @param blend_loss  luma error of pictures drawn from lossless patterns, mean over samples
/// @param patterns     number of patterns
/// @param other_bytes  bytes of the same pictures besides the patterns
[[nodiscard]] bool reduced_size_pays(double blend_loss, std::size_t patterns, double other_bytes,
                                     const PatternCost& full, const PatternCost& reduced);

}  // namespace fbs
