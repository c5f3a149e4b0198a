// Weights of a blend's sources, and weighted sums of samples. SPEC 11.6. Integers only.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "decoder/raster/row_block.h"

namespace fbs {

inline constexpr int kWeightOneLog2 = 12;
inline constexpr int kWeightOne = 1 << kWeightOneLog2;  ///< weights in a blend sum to this

/// Weights in units of 2^-8 suffice for many blends; their sums fit 16 bits.
inline constexpr int kCoarseOneLog2 = 8;
inline constexpr int kCoarseOne = 1 << kCoarseOneLog2;
inline constexpr int kCoarseStep = kWeightOne / kCoarseOne;

/// The weight of a source, linear over a triangle.
template <PlaneScale kScale>
class LinearWeight {
 public:
  /// @param weight  at the corners, 0..kWeightOne
  LinearWeight(const TriangleSetup& setup, const std::array<std::int32_t, 3>& weight)
      : gradient_(setup.gradient(weight, 0)), is_tame_(gradient_.exact()) {
    const auto step = static_cast<std::uint32_t>(gradient_.dx);
    steps_ = {WideLanes{0, 1, 2, 3} * step, WideLanes{4, 5, 6, 7} * step};
  }

  /// The weights of a block's samples, clamped to 0..left; subtracts them from `left`.
  [[nodiscard]] Lanes take(const RowBlock<kScale>& block, Lanes& left) const {
    const SignedLanes weight = is_tame_ ? at(block) : at_plain(block),
                      most = reinterpret_cast<SignedLanes>(left);
    const SignedLanes positive = weight > 0 ? weight : SignedLanes{};
    const auto taken = reinterpret_cast<Lanes>(positive < most ? positive : most);
    left -= taken;
    return taken;
  }

 private:
  [[nodiscard]] SignedLanes at(const RowBlock<kScale>& block) const {
    const auto first = static_cast<std::uint32_t>(block.along(gradient_).first);
    const auto low = reinterpret_cast<SignedLanes>(steps_[0] + first),
               high = reinterpret_cast<SignedLanes>(steps_[1] + first);
    constexpr int kA = 1 - kLowPart;  // place of the upper half of the first sum
    return __builtin_shufflevector(low, high, kA, kA + 2, kA + 4, kA + 6, kA + 8, kA + 10, kA + 12, kA + 14);
  }
  [[nodiscard, gnu::noinline]] SignedLanes at_plain(const RowBlock<kScale>& block) const {
    const LinearRow weight = block.along(gradient_);
    SignedLanes out{};
    for (int i = 0; i < block.count; ++i)
      out[i] = static_cast<std::int16_t>(
          std::clamp<std::int64_t>(weight.at(i) >> kGradientOneLog2, 0, kWeightOne));
    return out;
  }

  Gradient gradient_;
  bool is_tame_;  ///< whether it stays within the range of WideLanes
  std::array<WideLanes, 2> steps_;
};

/// Weighted sum of samples with weights of 2^-12, which does not fit 16 bits: one part sums products with the
/// weights rounded down to 2^-8, the other all products modulo 2^16. Their difference is the rounding error.
class WeightedSum {
 public:
  static constexpr int kMaxAdded = 16;  ///< the remainder of carry() and this many differences fit 16 bits

  void add(Lanes samples, Lanes weight) {
    coarse_ += samples * (weight >> kLowBits);
    all_ += samples * weight;
  }
  void carry() { coarse_ += rest(); }
  [[nodiscard]] Lanes rounded() const {
    return (coarse_ + rest() + std::uint16_t{kCoarseOne / 2}) >> kCoarseOneLog2;
  }

 private:
  static constexpr int kLowBits = kWeightOneLog2 - kCoarseOneLog2;
  [[nodiscard]] Lanes rest() const { return (all_ - (coarse_ << kLowBits)) >> kLowBits; }

  Lanes coarse_{}, all_{};
};

}  // namespace fbs
