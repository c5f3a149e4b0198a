// Keypoints of the surround: places of the first picture whose displacement can be measured.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "encoder/image/bilinear.h"
#include "encoder/image/pyramid.h"
#include "encoder/surround/layer_membership.h"

namespace fbs {

inline constexpr int kSurroundLevels = 2;
using SurroundPyramid = Pyramid<kSurroundLevels>;

/// The steepest place of a small square of the first picture.
struct Keypoint {
  /// One sample of each quarter of the square, which represent its look.
  struct Quarter {
    glm::ivec2 at{};  ///< work pixels
    float value = 0;
  };

  glm::dvec2 at{};                             ///< work pixels, of pixel centres
  glm::dvec2 place{};                          ///< pixels of the picture
  glm::dvec2 from_head{};                      ///< eye distances
  std::array<Sample, kSurroundLevels> seen{};  ///< luma, and its slope per work pixel of the level
  std::array<Quarter, 4> quarters{};
  std::array<float, 3> structure{};  ///< of the whole square: sums of dx dx, dx dy, dy dy
  LayerMembership layers;
  int rim_piece = -1;  ///< which of the ten pieces of the picture's rim it shows as ground; or none

  [[nodiscard]] bool on_rim() const { return rim_piece >= 0; }
};

/// The first picture's keypoints, row by row.
/// @param factor  pixels of the picture per work pixel
/// @param seen    pose of the head in it
[[nodiscard]] std::vector<Keypoint> select_keypoints(const SurroundPyramid& first, int factor,
                                                     const Pose& seen);

/// The same where the whole picture is ground.
/// @param origin     origin of `from_head`, pixels of the picture
/// @param unit_px    its unit, in place of an eye distance
[[nodiscard]] std::vector<Keypoint> select_ground_keypoints(const SurroundPyramid& first, int factor,
                                                            glm::dvec2 origin, double unit_px);

/// Whether enough ground is visible near the rim to tell whether the camera moves.
[[nodiscard]] bool ground_shows(std::span<const Keypoint> keypoints);

}  // namespace fbs
