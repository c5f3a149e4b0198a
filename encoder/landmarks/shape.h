// Shapes: the 68 landmarks of a face together (iBUG order), and the similarities between them.
#pragma once

#include <array>
#include <complex>
#include <glm/vec2.hpp>

#include "common/generic_head.h"

namespace fbs {

/// Positions in a picture, whose first pixel's centre is (0.5, 0.5), or in any other plane.
using Shape = std::array<glm::vec2, kLandmarkCount>;

/// Distance between the centres of the eyes, each the mean of its six points.
[[nodiscard]] float eye_distance(const Shape& shape);

[[nodiscard]] glm::vec2 mean_of(const Shape& shape);

/// The landmark on the other side of the face.
[[nodiscard]] int mirrored_landmark(int landmark);

/// Rotation, scale and shift of the plane, as complex numbers: z -> turn * z + shift.
struct PlaneSimilarity {
  std::complex<float> turn{1, 0}, shift{0, 0};

  [[nodiscard]] glm::vec2 operator()(glm::vec2 p) const {
    const std::complex<float> z = turn * std::complex<float>(p.x, p.y) + shift;
    return {z.real(), z.imag()};
  }
  [[nodiscard]] Shape operator()(const Shape& shape) const;
  [[nodiscard]] PlaneSimilarity inverse() const { return {1.F / turn, -shift / turn}; }

  /// The similarity that brings `from` nearest to `to` in least squares.
  [[nodiscard]] static PlaneSimilarity between(const Shape& from, const Shape& to);
};

}  // namespace fbs
