// Displacement between two states of points that move with head, body or ground. SPEC 10.1. Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

#include "common/state.h"
#include "decoder/head/head_projection.h"

namespace fbs {

/// Displacement of points on the head frame's plane z = 0 from one pose to another.
class HeadPlane {
 public:
  HeadPlane(const HeadPose& from, const HeadPose& to);

  /// 1/64 pixel; zero when `from` shows the head too far from the side to invert its plane.
  /// @param p  in pose `from`, 1/64 pixel
  [[nodiscard]] glm::ivec2 displacement(glm::ivec2 p) const;

 private:
  HeadPose from_, to_;
  bool moves_ = false;
  std::int64_t matrix_[2][2] = {};  ///< Q16
};

inline constexpr int kFromHeadOneLog2 = 8;  ///< distances from the head are in 1/256 eye distance

/// Displacement of a body or ground point, 1/64 pixel.
/// @param from, to    similarities, as State::body and State::ground
/// @param from_head   the point relative to the head's origin, 1/256 eye distance
[[nodiscard]] glm::ivec2 similarity_displacement(const std::array<std::int32_t, kSimilarityCount>& from,
                                                 const std::array<std::int32_t, kSimilarityCount>& to,
                                                 glm::ivec2 from_head);

}  // namespace fbs
