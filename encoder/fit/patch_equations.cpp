#include "encoder/fit/patch_equations.h"

#include <algorithm>

namespace fbs {

void PatchEquations::begin(std::size_t columns) {
  n_ = columns;
  lanes_ = (n_ + kLanes - 1) / kLanes * kLanes;
  waiting_ = 0;
  for (Columns& row : rows_) std::fill(row.begin() + n_, row.begin() + lanes_, 0.0F);
  std::fill_n(right_.begin(), n_, 0.0F);
  for (std::size_t i = 0; i < n_; ++i) std::fill_n(&left_[i * kMaxColumns], lanes_, 0.0F);
}

void PatchEquations::sum_up() {
  for (; waiting_ < kRows; ++waiting_) weight_[waiting_] = residual_[waiting_] = 0;
  waiting_ = 0;
  const auto& [a, b, c, d] = rows_;
  for (std::size_t i = 0; i < n_; ++i) {
    const float wa = weight_[0] * a[i], wb = weight_[1] * b[i], wc = weight_[2] * c[i],
                wd = weight_[3] * d[i];
    right_[i] += wa * residual_[0] + wb * residual_[1] + wc * residual_[2] + wd * residual_[3];
    float* out = &left_[i * kMaxColumns];
    for (std::size_t j = i / kLanes * kLanes; j < lanes_; ++j)
      out[j] += wa * a[j] + wb * b[j] + wc * c[j] + wd * d[j];
  }
}

void PatchEquations::add_to(std::span<const std::uint16_t> columns, NormalEquations& normal) {
  if (waiting_ > 0) sum_up();
  for (std::size_t i = 0; i < n_; ++i) {
    normal.right(columns[i]) += static_cast<double>(right_[i]);
    for (std::size_t j = i; j < n_; ++j)
      normal.left(columns[i], columns[j]) += static_cast<double>(left_[i * kMaxColumns + j]);
  }
}

}  // namespace fbs
