// Where the patterns of a picture show: each painted in its own colour.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "cli/video/colour.h"
#include "common/result.h"
#include "decoder/scene/scene.h"

namespace fbs::cli {

/// Blue, green, red.
using Bgr = std::array<std::uint8_t, 3>;

/// The colour of a pattern throughout a stream; colours repeat after kPatternColourCount patterns.
/// @param number  of the pattern in the stream
[[nodiscard]] Bgr pattern_colour(std::size_t number);
inline constexpr std::size_t kPatternColourCount = 24;

/// Draws the picture of `state` in BGR as if each pattern were of one colour: colours mix as the patterns'
/// samples do. Light and mouth interior, which belong to no pattern, are left out.
/// @param in_slot  number in the stream of each pattern of the scene
[[nodiscard]] Result<RgbImage> pattern_tint(const Scene& scene, const State& state,
                                            std::span<const std::size_t> in_slot);

}  // namespace fbs::cli
