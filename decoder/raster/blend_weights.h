// Weights of the sources of a blend, and sums of samples by them. SPEC 11.6. Integers only.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "decoder/raster/row_block.h"

namespace fbs {

inline constexpr int kWeightOneLog2 = 12;
inline constexpr int kWeightOne = 1 << kWeightOneLog2;  ///< weights in a blend sum to this

/// Weights in units of 2^-8 are enough for many blends; their sums fit into sixteen bits.
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

  /// The weights of a block's samples, clamped to 0..left; takes them off `left`.
  [[nodiscard]] Lanes take(const RowBlock<kScale>& block, Lanes& left) const {
    const Lanes weight = is_tame_ ? at(block) : at_plain(block);
    const Lanes above = weight > left;  // all bits set where it is
    const Lanes taken = (weight & ~above) | (left & above);
    left -= taken;
    return taken;
  }

 private:
  /// Negative ones are 0.
  [[nodiscard]] Lanes at(const RowBlock<kScale>& block) const {
    const auto first = static_cast<std::uint32_t>(block.along(gradient_).first);
    const auto low = reinterpret_cast<Lanes>(steps_[0] + first),
               high = reinterpret_cast<Lanes>(steps_[1] + first);
    const Lanes weight = __builtin_shufflevector(low, high, 1, 3, 5, 7, 9, 11, 13, 15);
    const Lanes negative = 0 - (weight >> 15);
    return weight & ~negative;
  }
  [[nodiscard]] Lanes at_plain(const RowBlock<kScale>& block) const {
    const LinearRow weight = block.along(gradient_);
    Lanes out{};
    for (int i = 0; i < block.count; ++i)
      out[i] = static_cast<std::uint16_t>(
          std::clamp<std::int64_t>(weight.at(i) >> kGradientOneLog2, 0, kWeightOne));
    return out;
  }

  Gradient gradient_;
  bool is_tame_;  ///< whether it stays within what WideLanes can hold
  std::array<WideLanes, 2> steps_;
};

/// Sum of samples by weights of 2^-12: two parts, since sixteen bits do not hold it.
class WeightedSum {
 public:
  static constexpr int kMaxAdded = 16;  ///< what carry() leaves and as many products fit into sixteen bits

  void add(Lanes samples, Lanes weight) {
    high_ += samples * (weight >> kLowBits);
    low_ += samples * (weight & ((1 << kLowBits) - 1));
  }
  void carry() {
    high_ += low_ >> kLowBits;
    low_ &= (1 << kLowBits) - 1;
  }
  [[nodiscard]] Lanes rounded() const {
    return (high_ + (low_ >> kLowBits) + std::uint16_t{kCoarseOne / 2}) >> kCoarseOneLog2;
  }

 private:
  static constexpr int kLowBits = kWeightOneLog2 - kCoarseOneLog2;
  Lanes high_{}, low_{};
};

}  // namespace fbs
