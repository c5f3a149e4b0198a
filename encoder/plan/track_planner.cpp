#include "encoder/plan/track_planner.h"

#include "bitstream/track.h"
#include "encoder/plan/knot_descent.h"

namespace fbs {
namespace {

constexpr int kMaxSweeps = 3;  // trades planning time for bits; most groups stop changing before

}  // namespace

TrackPlanner::TrackPlanner(const QuantiserSteps& steps, PartMask parts, cv::Mat1d penalty)
    : limits_(steps, parts), penalty_(std::move(penalty)) {
  for (std::size_t i = 0; i < kParameterCount; ++i) step_[i] = step_of(steps, i);
}

MotionGroup TrackPlanner::plan(const CodedState& anchor, std::span<const PictureCost> pictures,
                               const TrackRate& rate, double lambda) const {
  const GroupCost cost(pictures, penalty_, step_);
  const PlanTerms terms{cost, rate, limits_, lambda};
  MotionGroup group;
  group.anchor = anchor;
  group.pictures = cost.pictures();
  for (std::size_t part = 0; part < kPartCount; ++part)
    if (has_part(limits_.parts, part))
      group.tracks[part] = cheapest_spans(terms, part, anchor_knot(anchor, part).value);
  KnotDescent descent(terms, group);
  for (int sweep = 0; sweep < kMaxSweeps && descent.sweep(); ++sweep) {
  }
  return group;
}

}  // namespace fbs
