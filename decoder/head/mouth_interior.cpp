#include "decoder/head/mouth_interior.h"

#include <algorithm>

#include "decoder/head/head_deformation.h"

namespace fbs {
namespace {

// Landmarks of the inner lips: from the right corner over the upper lip to the left corner, then the lower
// lip.
constexpr std::size_t kRightCorner = 60, kUpperMiddle = 62, kLeftCorner = 64, kLowerMiddle = 66;

/// Lips that part by this much more than twice as far as in the pattern, head units, show nothing of the
/// pattern between them. A sixteenth of the eye distance; set by eye on the ten clips.
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

bool is_inner_lip(const WireFrame& head, std::size_t vertex) {
  return vertex < head.vertices.size() &&
         head.vertices[vertex].feature == static_cast<int>(FeatureId::kMouthInner);
}

bool is_mouth(const WireFrame& head, const HeadTriangle& corners) {
  return std::all_of(corners.begin(), corners.end(), [&](std::size_t v) { return is_inner_lip(head, v); });
}

std::int32_t mouth_ramp(const WireFrame& head, std::size_t inner_lip_vertex) {
  std::int32_t ramp = 0;
  for (const FeatureVertex& v : head.feature(FeatureId::kMouthInner).vertices) {
    const bool is_corner =
        v.vertex == head.vertex_of_landmark(kRightCorner) || v.vertex == head.vertex_of_landmark(kLeftCorner);
    if (v.vertex == inner_lip_vertex) return is_corner ? kMouthRampEnd / 2 : ramp;
    if (is_corner) ramp = v.vertex == head.vertex_of_landmark(kRightCorner) ? 0 : kMouthRampEnd;
  }
  return ramp;
}

InnerLips inner_lips(const WireFrame& head) {
  InnerLips out;
  const auto& vertices = head.feature(FeatureId::kMouthInner).vertices;
  const std::size_t left = head.vertex_of_landmark(kLeftCorner);
  std::size_t k = 0;
  do out.upper.push_back(vertices[k].vertex);
  while (vertices[k++].vertex != left);
  out.lower.push_back(vertices.front().vertex);
  for (std::size_t i = vertices.size(); i-- > k - 1;) out.lower.push_back(vertices[i].vertex);
  return out;
}

std::int32_t mouth_gap(const WireFrame& head, std::span<const glm::ivec3> vertices) {
  const auto y_of = [&](std::size_t landmark) { return vertices[head.vertex_of_landmark(landmark)].y; };
  return y_of(kLowerMiddle) - y_of(kUpperMiddle);
}

std::int32_t mouth_gap(const Geometry& neutral, const State& state) {
  return mouth_gap(neutral.wire_frame(), deform(neutral, state));
}

std::int32_t interior_opacity(std::int32_t gap, std::int32_t gap_seen) {
  return std::clamp(gap - std::max(gap_seen, 2 * gap_seen), 0, kInteriorOpaque);
}

std::array<std::int32_t, kInteriorCount> interior_base(const MouthInterior& mouth,
                                                       std::uint8_t YuvColour::*component) {
  const std::int32_t upper = (mouth.upper.*component) << kLevelOneLog2, lower = (mouth.lower.*component)
                                                                                << kLevelOneLog2;
  return {upper, (upper + lower) / 2, lower};
}

std::uint8_t with_interior(std::uint8_t sample, const InteriorColours& colours, std::int32_t ramp,
                           std::int32_t opacity) {
  constexpr std::int32_t kHalf = kMouthRampEnd / 2;
  const std::size_t upper = ramp < kHalf ? 0 : 1;
  const std::int32_t share = ramp < kHalf ? ramp : ramp - kHalf;  // of the lower of the two colours
  const std::int32_t colour =
      (colours[upper] * (kHalf - share) + colours[upper + 1] * share + kHalf / 2) / kHalf;
  return static_cast<std::uint8_t>(
      (sample * (kInteriorOpaque - opacity) + colour * opacity + kInteriorOpaque / 2) / kInteriorOpaque);
}

std::array<InteriorColours, 3> interior_colours(const MouthInterior& mouth,
                                                const std::array<std::int32_t, kInteriorCount>& added_luma) {
  auto luma = interior_base(mouth, &YuvColour::y);
  for (std::size_t i = 0; i < kInteriorCount; ++i) luma[i] += added_luma[i];
  return {rounded(luma), rounded(interior_base(mouth, &YuvColour::u)),
          rounded(interior_base(mouth, &YuvColour::v))};
}

}  // namespace fbs
