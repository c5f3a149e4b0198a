// Chooses the knots of a group: what the viewer will see of all its pictures against what they cost. Design
// section 6.
#pragma once

#include <span>
#include <vector>

#include "encoder/model/fit.h"
#include "encoder/plan/track_rate.h"

namespace fbs {

/// Minimises  sum over pictures of (x - fit)^T form (x - fit)  +  lambda * bits  over knots and their
/// numbers: for each part the best chain of straight spans by dynamic programming, then all numbers of all
/// parts together downhill in whole steps, dropping knots that do not pay.
class TrackPlanner {
 public:
  /// @param lambda  squared luma differences that a bit is worth
  TrackPlanner(const QuantiserSteps& steps, PartMask parts, double lambda);

  /// @param anchor  the coded state before the first picture
  /// @param fits    of the group's pictures, 1..kMaxGroupPictures
  /// @param rate    what knots cost
  [[nodiscard]] MotionGroup plan(const CodedState& anchor, std::span<const FitForm> fits,
                                 const TrackRate& rate) const;

  void set_lambda(double lambda) { lambda_ = lambda; }
  [[nodiscard]] double lambda() const { return lambda_; }

 private:
  CodedLimits limits_;
  std::array<double, kParameterCount> step_{};
  double lambda_;
};

}  // namespace fbs
