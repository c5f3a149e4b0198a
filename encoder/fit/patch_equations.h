// The normal equations of the points of one triangle.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "encoder/fit/fit_columns.h"
#include "encoder/fit/normal_equations.h"

namespace fbs {

/// Dense and in single precision: few control points move one triangle. 31 KB of scratch to keep between
/// triangles.
class PatchEquations {
 public:
  /// Empties them for points that this many control points move.
  void begin(std::size_t controls);

  /// To be filled before each add(): pose, light, mouth interior, x and y of each control point.
  [[nodiscard]] float* row() { return row_.data(); }

  /// @param r  residual of `row`
  void add(float weight, float r) {
    for (std::size_t i = 0; i < n_; ++i) {
      const float wi = weight * row_[i];
      right_[i] += wi * r;
      float* out = &left_[i * kMaxColumns];
      for (std::size_t j = i; j < n_; ++j) out[j] += wi * row_[j];
    }
  }

  /// @param controls  rising, so that the upper triangle stays one
  void add_to(const FitColumns& columns, std::span<const std::uint16_t> controls,
              NormalEquations& normal) const;

 private:
  static constexpr std::size_t kMaxColumns = kFitNumbers;

  std::size_t n_ = 0;
  alignas(32) std::array<float, kMaxColumns> row_;
  alignas(32) std::array<float, kMaxColumns> right_;
  alignas(32) std::array<float, kMaxColumns * kMaxColumns> left_;  ///< upper triangle
};

}  // namespace fbs
