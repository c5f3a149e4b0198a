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
class LinearWeight {
 public:
  /// @param weight  at the corners, 0..kWeightOne
  LinearWeight(const TriangleSetup& setup, const std::array<std::int32_t, 3>& weight);

  /// The weights of a block's samples, clamped to 0..left; takes them off `left`.
  [[nodiscard]] Lanes take(const RowBlock& block, Lanes& left) const {
    const Lanes weight = is_tame_ ? at(block) : at_plain(block);
    const Lanes above = weight > left;  // all bits set where it is
    const Lanes taken = (weight & ~above) | (left & above);
    left -= taken;
    return taken;
  }

 private:
  /// Negative ones are 0.
  [[nodiscard]] Lanes at(const RowBlock& block) const {
    const auto first = static_cast<std::uint32_t>(gradient_.at(block.at, position_bits_));
    const auto low = reinterpret_cast<Lanes>(steps_[0] + first), high = reinterpret_cast<Lanes>(steps_[1] + first);
    const Lanes weight = __builtin_shufflevector(low, high, 1, 3, 5, 7, 9, 11, 13, 15);
    const Lanes negative = 0 - (weight >> 15);
    return weight & ~negative;
  }
  [[nodiscard]] Lanes at_plain(const RowBlock& block) const;

  Gradient gradient_;
  int position_bits_;
  bool is_tame_;  ///< whether it stays within what WideLanes can hold
  std::array<WideLanes, 2> steps_;
};

/// Sums of samples by weights of 2^-12: two parts, since sixteen bits do not hold them.
class WeightedSum {
 public:
  void add(Lanes samples, Lanes weight) {
    high_ += samples * (weight >> kLowBits);
    low_ += samples * (weight & ((1 << kLowBits) - 1));
    if (++added_ % kMaxAdded == 0) carry();
  }
  /// Rounded.
  [[nodiscard]] Lanes samples() {
    carry();
    return (high_ + kCoarseOne / 2) >> kCoarseOneLog2;
  }

 private:
  static constexpr int kLowBits = kWeightOneLog2 - kCoarseOneLog2;
  static constexpr int kMaxAdded = 16;  // 16 * 15 * 255 and a carry fit into sixteen bits
  void carry() {
    high_ += low_ >> kLowBits;
    low_ &= (1 << kLowBits) - 1;
  }
  Lanes high_{}, low_{};
  int added_ = 0;
};

}  // namespace fbs
