// Normal equations of the head's alignment, summed in single precision, several points at a time.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <opencv2/core.hpp>

#include "encoder/image/bilinear.h"
#include "encoder/model/pose_jacobian.h"

namespace fbs {

/// Unknowns: the pose's six numbers, gain and offset of the light. Gathers points in blocks to vectorise the
/// loops over them.
class AlignmentSums {
 public:
  static constexpr int kUnknowns = 8;
  using Matrix = cv::Matx<double, kUnknowns, kUnknowns>;
  using Vector = cv::Vec<double, kUnknowns>;

  /// @param pixels_per_unit  pixels of the level per pixel of the picture
  /// @param sigma  outlier scale of Geman-McClure, grey levels
  AlignmentSums(const PoseJacobian& jacobian, double pixels_per_unit, double sigma);

  /// @param seen  luma in the first picture
  /// @param difference  `seen` under the light's gain and offset, less the sample
  /// @param weight  without the robust weight, which add() computes
  void add(glm::vec3 point, const Sample& s, float seen, float difference, float weight) {
    const std::size_t k = count_++;
    for (std::size_t axis = 0; axis < 3; ++axis) point_[axis][k] = point[static_cast<int>(axis)];
    dx_[k] = s.dx;
    dy_[k] = s.dy;
    seen_[k] = seen;
    difference_[k] = difference;
    weight_[k] = weight;
    if (count_ == kBlock) flush();
  }

  /// Adds to the upper triangle of `a` and to `b`.
  void finish(Matrix& a, Vector& b);

 private:
  static constexpr std::size_t kBlock = 64, kLanes = 8;
  static constexpr std::array<std::size_t, 4> kRotationsAndScale = {0, 1, 2, 5};  // these move a point
                                                                                  // depending on its position
  using Row = float[kBlock];

  void flush();
  static float dot(const Row& a, const Row& b, std::size_t n);

  float pixels_per_unit_, per_variance_;
  std::array<std::array<float, 3>, 4> by_x_, by_y_;
  alignas(16) Row point_[3] = {}, dx_ = {}, dy_ = {}, seen_ = {}, difference_ = {}, weight_ = {};
  std::size_t count_ = 0;
  std::array<double, kUnknowns*(kUnknowns + 3) / 2> sums_{};  ///< rows of the upper triangle, each with b's
};

}  // namespace fbs
