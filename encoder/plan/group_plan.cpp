#include "encoder/plan/group_plan.h"

#include <algorithm>

#include "encoder/plan/rate_control.h"

namespace fbs {
namespace {

constexpr std::size_t kPacketBytes = 5;  // added to a motion payload by its packet: SPEC 3.1

}  // namespace

std::vector<std::uint32_t> group_durations(std::span<const std::uint32_t> durations,
                                           std::uint32_t nominal_duration) {
  if (std::all_of(durations.begin(), durations.end(), [](std::uint32_t d) { return d == 0; })) return {};
  std::vector<std::uint32_t> out(durations.begin(), durations.end());
  std::replace(out.begin(), out.end(), std::uint32_t{0}, nominal_duration);
  return out;
}

double seconds_of(std::span<const std::uint32_t> durations, std::uint32_t nominal_duration) {
  double seconds = 0;
  for (const std::uint32_t d : durations) seconds += (d > 0 ? d : nominal_duration) / 90000.0;
  return seconds;
}

MotionGroup plan_group(const TrackPlanner& planner, const GroupInput& input, double lambda) {
  MotionGroup group = planner.plan(input.coder.anchor(), input.pictures, input.rate, lambda);
  group.key = input.key;
  group.first = input.coder.next();
  group.durations = group_durations(input.durations, input.nominal_duration);
  return group;
}

PlannedGroup plan_group_within(const TrackPlanner& planner, const GroupInput& input, double allowed_bits,
                               double lambda, double base) {
  return plan_within(allowed_bits, lambda, base, [&](double at) {
    PlannedGroup planned{plan_group(planner, input, at), at, 0};
    const auto payload = MotionEncoder(input.coder).encode(planned.group);
    planned.bits = 8.0 * static_cast<double>((payload ? payload->size() : 0) + kPacketBytes);
    return planned;
  });
}

}  // namespace fbs
