// A part's first track: the cheapest chain of straight spans, by dynamic programming.
#pragma once

#include "encoder/plan/group_cost.h"
#include "encoder/plan/track_rate.h"

namespace fbs {

/// Terms of the choice of knots.
struct PlanTerms {
  const GroupCost& cost;
  const TrackRate& rate;
  const CodedLimits& limits;
  double lambda;  ///< squared luma levels that a bit is worth
};

/// The cheapest chain of one part through the fits in whole steps, with all other parts at their targets.
/// From a knot a span goes straight to a later one, or holds and jumps to it within one picture, or holds to
/// the end.
/// @param anchor  the part before the first picture
[[nodiscard]] Track cheapest_spans(const PlanTerms& terms, std::size_t part, const PartValues& anchor);

}  // namespace fbs
