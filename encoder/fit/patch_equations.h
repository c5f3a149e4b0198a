// The normal equations of the points of one triangle.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "encoder/fit/fit_columns.h"
#include "encoder/fit/normal_equations.h"

namespace fbs {

/// Dense and in single precision: few control points move one triangle. Sums several rows at a time, which
/// takes a third of the time. 32 KB of scratch memory, to be reused between triangles.
class PatchEquations {
 public:
  /// Starts anew for rows of this many columns.
  void begin(std::size_t columns);

  /// The next row, to be filled before each add().
  [[nodiscard]] float* row() { return rows_[waiting_].data(); }

  /// @param r  residual of `row`
  void add(float weight, float r) {
    weight_[waiting_] = weight;
    residual_[waiting_] = r;
    if (++waiting_ == kRows) sum_up();
  }

  /// @param columns  of the equations, rising, so that the upper triangle stays one
  void add_to(std::span<const std::uint16_t> columns, NormalEquations& normal);

 private:
  static constexpr std::size_t kRows = 4, kLanes = 4;
  static constexpr std::size_t kMaxColumns = (kFitNumbers + kLanes - 1) / kLanes * kLanes;
  using Columns = std::array<float, kMaxColumns>;

  /// Adds the waiting rows.
  void sum_up();

  std::size_t n_ = 0;
  std::size_t lanes_ = 0;  ///< n_ in whole lanes; the columns after n_ are zero
  std::size_t waiting_ = 0;
  std::array<float, kRows> weight_, residual_;
  alignas(32) std::array<Columns, kRows> rows_{};
  alignas(32) Columns right_;
  alignas(32) std::array<float, kMaxColumns * kMaxColumns> left_;  ///< upper triangle
};

}  // namespace fbs
