#include "decoder/head/mouth_interior.h"

#include <algorithm>

namespace fbs {
namespace {

// Landmarks of the inner lips: from the right corner over the upper lip to the left corner, then the lower
// lip.
constexpr int kFirstInnerLip = 60, kUpperMiddle = 62, kLeftCorner = 64, kLowerMiddle = 66;

/// Lips that part by this much more than in the pattern show nothing of it between them, head units. A
/// sixteenth of the eye distance; set by eye on the ten clips.
constexpr std::int32_t kOpaqueGap = kUnitsPerEyeDistance / 16;
static_assert(kOpaqueGap == kInteriorOpaque, "one head unit of gap is one step of opacity");

constexpr int kLevelOneLog2 = 4;  // 1/16 grey level

/// @param levels  1/16 grey level
InteriorColours rounded(const std::array<std::int32_t, kInteriorCount>& levels) {
  InteriorColours colours{};
  for (std::size_t i = 0; i < kInteriorCount; ++i) {
    const std::int32_t level = (levels[i] + (1 << (kLevelOneLog2 - 1))) >> kLevelOneLog2;
    colours[i] = static_cast<std::uint8_t>(std::clamp(level, 0, 255));
  }
  return colours;
}

}  // namespace

bool is_inner_lip(std::size_t vertex) {
  return vertex < kVertexCount && generic_head().vertices[vertex].landmark >= kFirstInnerLip;
}

std::int32_t mouth_ramp(std::size_t inner_lip_vertex) {
  const int landmark = generic_head().vertices[inner_lip_vertex].landmark;
  if (landmark == kFirstInnerLip || landmark == kLeftCorner) return kMouthRampEnd / 2;
  return landmark < kLeftCorner ? 0 : kMouthRampEnd;
}

std::int32_t mouth_gap(const std::array<glm::ivec3, kVertexCount>& vertices) {
  const auto y_of = [&](std::size_t landmark) { return vertices[vertex_of_landmark(landmark)].y; };
  return y_of(kLowerMiddle) - y_of(kUpperMiddle);
}

std::int32_t interior_opacity(std::int32_t gap, std::int32_t gap_seen) {
  return std::clamp(gap - gap_seen, 0, kInteriorOpaque);
}

std::array<std::int32_t, kInteriorCount> interior_base(const MouthInterior& mouth,
                                                       std::uint8_t YuvColour::*component) {
  const std::int32_t upper = (mouth.upper.*component) << kLevelOneLog2, lower = (mouth.lower.*component)
                                                                                << kLevelOneLog2;
  return {upper, (upper + lower) / 2, lower};
}

std::array<InteriorColours, 3> interior_colours(const MouthInterior& mouth,
                                                const std::array<std::int32_t, kInteriorCount>& added_luma) {
  auto luma = interior_base(mouth, &YuvColour::y);
  for (std::size_t i = 0; i < kInteriorCount; ++i) luma[i] += added_luma[i];
  return {rounded(luma), rounded(interior_base(mouth, &YuvColour::u)),
          rounded(interior_base(mouth, &YuvColour::v))};
}

}  // namespace fbs
