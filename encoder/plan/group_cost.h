// Costs of a group's pictures for the planner, over numbers in whole steps.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bitstream/syntax.h"
#include "encoder/model/picture_cost.h"

namespace fbs {

/// Numbers of one part: as coded, and between knots.
using PartValues = std::array<std::int32_t, kMaxPartSize>;
using PartPoint = std::array<double, kMaxPartSize>;

/// Targets and quadratics of a group's pictures, both in quantiser steps.
class GroupCost {
 public:
  using Row = std::array<double, kParameterCount>;

  /// @param penalty  added to each picture's quadratic, kParameterCount x kParameterCount; empty: none
  GroupCost(std::span<const PictureCost> pictures, const cv::Mat1d& penalty,
            const std::array<double, kParameterCount>& step);

  [[nodiscard]] int pictures() const { return static_cast<int>(target_.size()); }
  /// The fit of picture t.
  [[nodiscard]] const Row& target(std::size_t t) const { return target_[t]; }
  /// kParameterCount x kParameterCount, row by row.
  [[nodiscard]] const float* quadratic(std::size_t t) const { return quadratic_[t].data(); }

  /// Distortion of one part alone in picture t, all others being at their targets.
  [[nodiscard]] double distortion(std::size_t part, std::size_t t, const PartPoint& x) const;

  /// The target of a part in whole steps, within the limits.
  [[nodiscard]] PartValues rounded(std::size_t part, std::size_t t, const CodedLimits& limits) const;

 private:
  std::vector<Row> target_;
  std::vector<std::vector<float>> quadratic_;
};

/// A part on the straight line between two of its values; share 0 is `from`, 1 is `to`. Numbers past the
/// part's size are left undefined.
[[nodiscard]] inline PartPoint on_line(const PartValues& from, const PartValues& to, std::size_t part,
                                       double share) {
  PartPoint x;
  for (std::size_t k = 0; k < kPartSizes[part]; ++k) x[k] = from[k] + (to[k] - from[k]) * share;
  return x;
}

}  // namespace fbs
