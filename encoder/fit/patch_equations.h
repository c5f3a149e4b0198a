// The normal equations of the points of one triangle.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "encoder/fit/normal_equations.h"

namespace fbs {

/// Dense and in single precision: few control points move one triangle. Keeps the rows and sums them all at
/// once. To be reused between triangles.
class PatchEquations {
 public:
  /// Starts anew.
  /// @param columns  of each row  @param most  rows that may follow
  void begin(std::size_t columns, std::size_t most);

  /// The next row, to be filled before each add().
  [[nodiscard]] float* row() { return &rows_[count_ * stride_]; }

  /// @param r  residual of `row`
  void add(float weight, float r) {
    float* end = row() + n_;
    *end++ = r;
    std::fill(end, row() + stride_, 0.0F);
    weights_[count_++] = weight;
  }

  /// @param columns  of the equations, rising, so that the upper triangle stays one
  void add_to(std::span<const std::uint16_t> columns, NormalEquations& normal);

 private:
  std::size_t n_ = 0;
  std::size_t stride_ = 0;              ///< n_ and the residual, in whole lanes; the rest is zero
  std::size_t count_ = 0;               ///< of rows
  std::vector<float> rows_, weighted_;  ///< in whole groups
  std::vector<float> weights_;          ///< of the rows
  std::vector<float> sums_;             ///< upper triangle; the right side is its column n_
};

}  // namespace fbs
