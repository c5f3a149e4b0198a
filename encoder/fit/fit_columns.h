// Which numbers of a fit are unknowns, and their columns in the normal equations.
#pragma once

#include <array>
#include <vector>

#include "encoder/model/fit.h"

namespace fbs {

/// Pose, light and mouth interior first, in the order of kFitNumbers; then x and y of each control point of
/// the parts that the stream sends.
class FitColumns {
 public:
  static constexpr std::size_t kFirstLight = kPoseCount;
  static constexpr std::size_t kFirstInterior = kPoseCount + kLightCount;
  static constexpr std::size_t kFirstControl = kFitOffsets;

  explicit FitColumns(PartMask parts);

  [[nodiscard]] int count() const { return count_; }
  /// Whether a control point may move.
  [[nodiscard]] bool has(std::size_t control) const { return of_[control] >= 0; }
  /// Column of a control point's x; y follows. Only for control points that may move.
  [[nodiscard]] std::size_t of(std::size_t control) const { return static_cast<std::size_t>(of_[control]); }

  /// Index among kFitNumbers of each column.
  [[nodiscard]] std::vector<int> numbers() const;

 private:
  std::array<int, kControlCount> of_;
  int count_ = kFitOffsets;
};

}  // namespace fbs
