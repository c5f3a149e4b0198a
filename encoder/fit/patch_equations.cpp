#include "encoder/fit/patch_equations.h"

#include "encoder/fit/row_sums.h"

namespace fbs {
namespace {

constexpr std::size_t rounded_up(std::size_t n, std::size_t unit) {
  return (n + unit - 1) / unit * unit;
}

}  // namespace

void PatchEquations::begin(std::size_t columns, std::size_t most) {
  n_ = columns;
  stride_ = rounded_up(n_ + 1, kRowLanes);
  count_ = 0;
  weights_.resize(rounded_up(most, kRowsTogether));
  rows_.resize(weights_.size() * stride_);
  weighted_.resize(rows_.size());
  sums_.resize(stride_ * stride_);
}

void PatchEquations::add_to(std::span<const std::uint16_t> columns, NormalEquations& normal) {
  const std::size_t whole = rounded_up(count_, kRowsTogether);
  std::fill(weights_.begin() + static_cast<std::ptrdiff_t>(count_), weights_.end(), 0.0F);
  for (std::size_t k = 0; k < whole; ++k) {
    const float *from = &rows_[k * stride_], weight = weights_[k];
    float* to = &weighted_[k * stride_];
    for (std::size_t i = 0; i < stride_; ++i) to[i] = weight * from[i];
  }
  sum_products(rows_.data(), weighted_.data(), whole, stride_, sums_.data());
  for (std::size_t i = 0; i < n_; ++i) {
    const float* sums = &sums_[i * stride_];
    normal.right(columns[i]) += static_cast<double>(sums[n_]);
    double* left = &normal.left(columns[i], 0);
    for (std::size_t j = i; j < n_; ++j) left[columns[j]] += static_cast<double>(sums[j]);
  }
}

}  // namespace fbs
