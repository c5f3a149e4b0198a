// The points of the head at which patterns and pictures are compared.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "encoder/fit/fit_columns.h"
#include "encoder/model/placed_head.h"

namespace fbs {

/// Points fixed on the mesh, with their light, mouth interior, and the control points that move them.
/// Independent of any picture, so that several patterns can share them.
class SamplePoints {
 public:
  /// The points of one triangle, and the share of each control point in the motion of each.
  struct Patch {
    std::size_t first, end;               ///< points
    std::vector<std::uint16_t> controls;  ///< rising; only those that may move
    std::vector<float> shares;            ///< of each control point, point by point
    /// FitColumns of a point's row, rising: pose, light, mouth interior where the triangle lies there, x and
    /// y of `controls`.
    std::vector<std::uint16_t> columns;

    [[nodiscard]] std::size_t size() const { return end - first; }
  };

  /// Spreads the points evenly over the head as placed by `seen`.
  /// @param spacing_px  pixels of the picture
  SamplePoints(const Geometry& geometry, const FitColumns& columns, const PlacedHead& seen,
               double spacing_px);

  [[nodiscard]] std::size_t size() const { return points_.size(); }
  [[nodiscard]] const SurfacePoint& operator[](std::size_t k) const { return points_[k]; }
  /// All points, triangle by triangle.
  [[nodiscard]] std::span<const Patch> patches() const { return patches_; }
  /// Luma added by one grey level of each number of the light, except the gain, which is zero here: linear
  /// between the corners of the expressionless head, as in the decoder.
  [[nodiscard]] const std::array<double, kLightCount>& light(std::size_t k) const { return light_[k]; }
  /// Samples of the full picture that each point of patch `n` represents; zero when it faces away.
  [[nodiscard]] double samples_per_point(std::size_t n, const PlacedHead& head) const;
  /// 0 at the upper lip, 1 at the lower; negative: not in the mouth interior.
  [[nodiscard]] double mouth_ramp(std::size_t k) const { return static_cast<double>(mouth_ramp_[k]); }

 private:
  [[nodiscard]] Patch patch_of(const FitColumns& columns, std::size_t first, std::size_t end) const;

  std::vector<SurfacePoint> points_;
  std::vector<Patch> patches_;
  std::vector<std::array<double, kLightCount>> light_;
  std::vector<float> mouth_ramp_;
};

}  // namespace fbs
