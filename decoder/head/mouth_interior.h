// The inside of the mouth between parted lips: place, opacity and colours. SPEC 10.10. Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "bitstream/syntax.h"
#include "common/generic_head.h"
#include "common/state.h"

namespace fbs {

inline constexpr std::int32_t kInteriorOpaque = 256;  ///< opacity: the pattern is hidden
inline constexpr std::int32_t kMouthRampEnd = 256;    ///< place in the mouth: 0 at the upper lip, this at the
                                                      ///< lower

/// The colours fade towards the lips over this share of the opening, 1/256, on either side, and over one luma
/// sample at least: no hard edge, and none of a line where lips only just part.
inline constexpr std::int32_t kInteriorFade = 77;

/// Whether the vertex lies on the inner lips; never on the ring. A triangle of three such vertices is mouth
/// interior.
[[nodiscard]] bool is_inner_lip(const WireFrame& head, std::size_t vertex);

/// 0 at the upper inner lip, half of kMouthRampEnd at the corners, kMouthRampEnd at the lower inner lip.
[[nodiscard]] std::int32_t mouth_ramp(const WireFrame& head, std::size_t inner_lip_vertex);

/// Whether a triangle is mouth interior.
/// @param corners  vertices of a HeadMesh
[[nodiscard]] bool is_mouth(const WireFrame& head, const HeadTriangle& corners);

/// Vertices of the inner lips, from the right corner to the left one, corners included.
struct InnerLips {
  std::vector<std::uint16_t> upper, lower;
};
[[nodiscard]] InnerLips inner_lips(const WireFrame& head);

/// Distance between the middles of the inner lips of a head as deform() returns it, head units.
[[nodiscard]] std::int32_t mouth_gap(const WireFrame& head, std::span<const glm::ivec3> vertices);

/// The same for an adapted head in a state.
[[nodiscard]] std::int32_t mouth_gap(const Geometry& neutral, const State& state);

/// Opacity of the interior over the pattern between the lips: 0..kInteriorOpaque. A pattern with parted lips
/// shows teeth and tongue, which look better stretched than painted over: the colours begin where the lips
/// part twice as far as in the pattern, and hide it at a sixteenth of the eye distance more.
/// @param gap, gap_seen  mouth_gap() in the picture and in the pattern's seen state
[[nodiscard]] std::int32_t interior_opacity(std::int32_t gap, std::int32_t gap_seen);

/// One component of the setup's colours at the upper lip, half way and at the lower lip, 1/16 grey level.
[[nodiscard]] std::array<std::int32_t, kInteriorCount> interior_base(const MouthInterior& mouth,
                                                                     std::uint8_t YuvColour::*component);

/// The values of one plane at the upper lip, half way and at the lower lip.
using InteriorColours = std::array<std::uint8_t, kInteriorCount>;

/// Colours in the Y, U and V planes: interior_base(), in luma with the state's offsets added, rounded to grey
/// levels.
/// @param added_luma  State::interior, 1/16 grey level
[[nodiscard]] std::array<InteriorColours, 3> interior_colours(
    const MouthInterior& mouth, const std::array<std::int32_t, kInteriorCount>& added_luma);

/// A sample with the colour of a place in the mouth mixed in.
/// @param ramp     place between upper and lower lip, 0..kMouthRampEnd
/// @param opacity  0..kInteriorOpaque
[[nodiscard]] std::uint8_t with_interior(std::uint8_t sample, const InteriorColours& colours,
                                         std::int32_t ramp, std::int32_t opacity);

}  // namespace fbs
