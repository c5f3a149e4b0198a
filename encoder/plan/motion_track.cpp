#include "encoder/plan/motion_track.h"

#include <utility>

#include "bitstream/track.h"
#include "encoder/plan/expression_penalty.h"

namespace fbs {

MotionTrack::MotionTrack(const Setup& setup, const CodedState& seen, const RatePlan& rate,
                         const SceneTiming& timing)
    : steps_(setup.steps),
      timing_(timing),
      coder_(setup, seen, timing.repeats_moved),
      planner_(setup.steps, setup.parts, expression_penalty(rate.point.lambda)),
      base_lambda_(rate.point.lambda),
      lambda_(base_lambda_) {
  if (rate.motion_kbps > 0) budget_.emplace(rate.motion_kbps);
}

Result<MotionTrack::Group> MotionTrack::add(std::span<const PictureCost> pictures,
                                            std::span<const std::uint32_t> durations) {
  const MotionGroup group = plan(pictures, durations);
  auto payload = coder_.encode(group);
  if (!payload) return fail(payload.error());
  rate_.learn(group);
  return Group{states_of(group, steps_), std::move(*payload)};
}

MotionGroup MotionTrack::plan(std::span<const PictureCost> pictures,
                              std::span<const std::uint32_t> durations) {
  const bool key = coder_.groups() % timing_.groups_per_key == 0;
  const GroupInput input{coder_, key, pictures, durations, timing_.nominal_duration, rate_};
  if (!budget_) return plan_group(planner_, input, lambda_);
  const double seconds = seconds_of(durations, timing_.nominal_duration);
  PlannedGroup planned = plan_group_within(planner_, input, budget_->allowed(seconds), lambda_, base_lambda_);
  budget_->spend(planned.bits, seconds);
  lambda_ = planned.lambda;
  return std::move(planned.group);
}

}  // namespace fbs
