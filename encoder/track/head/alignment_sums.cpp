#include "encoder/track/head/alignment_sums.h"

#include "encoder/image/robust.h"

namespace fbs {

AlignmentSums::AlignmentSums(const PoseJacobian& jacobian, double pixels_per_unit, double sigma)
    : pixels_per_unit_(static_cast<float>(pixels_per_unit)),
      per_variance_(static_cast<float>(1 / (sigma * sigma))) {
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 unit(0);
    unit[axis] = 1;
    const auto by = jacobian.at(unit);
    for (std::size_t m = 0; m < kRotationsAndScale.size(); ++m) {
      by_x_[m][axis] = static_cast<float>(pixels_per_unit * by[kRotationsAndScale[m]].x);
      by_y_[m][axis] = static_cast<float>(pixels_per_unit * by[kRotationsAndScale[m]].y);
    }
  }
}

void AlignmentSums::finish(Matrix& a, Vector& b) {
  while (count_ > 0 && count_ % kLanes != 0) weight_[count_++] = 0;
  flush();
  std::size_t k = 0;
  for (int m = 0; m < kUnknowns; ++m) {
    for (int n = m; n < kUnknowns; ++n) a(m, n) += sums_[k++];
    b[m] += sums_[k++];
  }
}

void AlignmentSums::flush() {
  const std::size_t n = count_;
  alignas(16) Row j[kUnknowns + 1], weighted;
  for (std::size_t m = 0; m < kRotationsAndScale.size(); ++m) {
    const std::array<float, 3> bx = by_x_[m], by = by_y_[m];
    for (std::size_t k = 0; k < n; ++k)
      j[kRotationsAndScale[m]][k] =
          dx_[k] * (bx[0] * point_[0][k] + bx[1] * point_[1][k] + bx[2] * point_[2][k]) +
          dy_[k] * (by[0] * point_[0][k] + by[1] * point_[1][k] + by[2] * point_[2][k]);
  }
  for (std::size_t k = 0; k < n; ++k) {
    j[3][k] = pixels_per_unit_ * dx_[k];
    j[4][k] = pixels_per_unit_ * dy_[k];
    j[6][k] = -seen_[k];
    j[7][k] = -1;
    j[8][k] = difference_[k];
    weight_[k] /= geman_mcclure_divisor(difference_[k] * difference_[k] * per_variance_);
  }
  std::size_t to = 0;
  for (std::size_t m = 0; m < kUnknowns; ++m) {
    for (std::size_t k = 0; k < n; ++k) weighted[k] = weight_[k] * j[m][k];
    for (std::size_t i = m; i < kUnknowns + 1; ++i)
      sums_[to++] += static_cast<double>(dot(weighted, j[i], n));
  }
  count_ = 0;
}

float AlignmentSums::dot(const Row& a, const Row& b, std::size_t n) {
  alignas(16) float sum[kLanes] = {};
  for (std::size_t k = 0; k < n; k += kLanes)
    for (std::size_t l = 0; l < kLanes; ++l) sum[l] += a[k + l] * b[k + l];
  return ((sum[0] + sum[4]) + (sum[1] + sum[5])) + ((sum[2] + sum[6]) + (sum[3] + sum[7]));
}

}  // namespace fbs
