// Chooses the knots of a group: weighs the error of all its pictures against bits.
#pragma once

#include <span>

#include "encoder/model/picture_cost.h"
#include "encoder/plan/track_rate.h"

namespace fbs {

/// Minimises  sum over pictures of their cost  +  lambda * bits  over knots and their numbers: for each part
/// the best chain of straight spans by dynamic programming, then all numbers of all parts together by descent
/// in whole steps, dropping knots that do not pay.
class TrackPlanner {
 public:
  /// @param penalty  added to each picture's quadratic, kParameterCount x kParameterCount; empty: none
  TrackPlanner(const QuantiserSteps& steps, PartMask parts, cv::Mat1d penalty = {});

  /// @param anchor    the coded state before the first picture
  /// @param pictures  costs of the group's pictures, 1..kMaxGroupPictures
  /// @param rate      bits of knots
  /// @param lambda    squared luma levels that a bit is worth
  [[nodiscard]] MotionGroup plan(const CodedState& anchor, std::span<const PictureCost> pictures,
                                 const TrackRate& rate, double lambda) const;

 private:
  CodedLimits limits_;
  std::array<double, kParameterCount> step_{};
  cv::Mat1d penalty_;
};

}  // namespace fbs
