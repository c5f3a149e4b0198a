#include "encoder/fit/patch_equations.h"

#include <algorithm>

namespace fbs {

void PatchEquations::begin(std::size_t controls) {
  n_ = FitColumns::kFirstControl + 2 * controls;
  std::fill_n(right_.begin(), n_, 0.0F);
  for (std::size_t i = 0; i < n_; ++i) std::fill_n(&left_[i * kMaxColumns], n_, 0.0F);
}

void PatchEquations::add_to(const FitColumns& columns, std::span<const std::uint16_t> controls,
                            NormalEquations& normal) const {
  std::array<std::size_t, kMaxColumns> column;
  for (std::size_t i = 0; i < FitColumns::kFirstControl; ++i) column[i] = i;
  for (std::size_t c = 0; c < controls.size(); ++c)
    for (std::size_t axis = 0; axis < 2; ++axis)
      column[FitColumns::kFirstControl + 2 * c + axis] = columns.of(controls[c]) + axis;
  for (std::size_t i = 0; i < n_; ++i) {
    normal.right(column[i]) += static_cast<double>(right_[i]);
    for (std::size_t j = i; j < n_; ++j)
      normal.left(column[i], column[j]) += static_cast<double>(left_[i * kMaxColumns + j]);
  }
}

}  // namespace fbs
