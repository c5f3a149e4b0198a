// Head pose and its weak perspective projection. SPEC 8.1 to 8.4. Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/generic_head.h"
#include "common/state.h"

namespace fbs {

inline constexpr int kHeadOneLog2 = 12;  ///< head units are 2^-12 eye distance
static_assert(kUnitsPerEyeDistance == 1 << kHeadOneLog2);

inline constexpr int kScreenOneLog2 = 6;             ///< screen positions are in 1/64 pixel
inline constexpr std::int32_t kMaxScreen = 1 << 21;  ///< screen positions are clamped to +- this

[[nodiscard]] constexpr std::int64_t to_screen(std::int64_t pixels) {
  return pixels << kScreenOneLog2;
}
[[nodiscard]] std::int32_t clamp_screen(std::int64_t v);

/// Head pose. x right, y down, z away from the viewer, right-handed;
/// rotation is roll * yaw * pitch, pitch first; projection is weak perspective (scaled orthographic).
struct HeadPose {
  std::int32_t pitch = 0;    ///< about x, 2^-16 turn; positive: the face looks down
  std::int32_t yaw = 0;      ///< about y, 2^-16 turn; positive: the face looks to the picture's left
  std::int32_t roll = 0;     ///< about z, 2^-16 turn; positive: clockwise in the picture
  std::int32_t shift_x = 0;  ///< screen position of the head frame's origin, 1/64 pixel
  std::int32_t shift_y = 0;
  std::int32_t log_scale = 0;  ///< eye distance in pixels is 2^(log_scale / 4096)
  friend bool operator==(const HeadPose&, const HeadPose&) = default;
};

[[nodiscard]] HeadPose head_pose(const State& state);

/// Linear part of the projection: screen = (matrix * p) * scale + shift.
struct HeadProjection {
  std::array<std::array<std::int32_t, 3>, 3> rotation;  ///< Q14
  std::int64_t scale;                                   ///< pixels per eye distance, Q16
  glm::ivec2 shift;                                     ///< 1/64 pixel

  explicit HeadProjection(const HeadPose& pose);

  /// @param p head units  @return x, y: 1/64 pixel, clamped to +-kMaxScreen; z: head units, larger is farther
  [[nodiscard]] glm::ivec3 operator()(glm::ivec3 p) const;
};

}  // namespace fbs
