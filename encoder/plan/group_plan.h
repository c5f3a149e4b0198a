// One motion group: which knots, at which lambda, for how many bits. Pure functions; what goes on from group
// to group is the caller's.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/motion/motion_encoder.h"
#include "encoder/plan/track_planner.h"

namespace fbs {

/// What a group's plan depends on.
struct GroupInput {
  const MotionEncoder& coder;  ///< as it is before the group: anchor and contexts
  std::span<const PictureCost> pictures;
  std::span<const std::uint32_t> durations;  ///< of each picture, 1/90000 s; 0: nominal
  std::uint32_t nominal_duration;            ///< 1/90000 s
  const TrackRate& rate;
};

struct PlannedGroup {
  MotionGroup group;
  double lambda = 0;
  double bits = 0;  ///< of the packet, header included
};

/// Durations as a MotionGroup holds them: empty when all are nominal.
[[nodiscard]] std::vector<std::uint32_t> group_durations(std::span<const std::uint32_t> durations,
                                                         std::uint32_t nominal_duration);

/// Length of a group.
[[nodiscard]] double seconds_of(std::span<const std::uint32_t> durations, std::uint32_t nominal_duration);

/// The group at a fixed lambda.
[[nodiscard]] MotionGroup plan_group(const TrackPlanner& planner, const GroupInput& input, double lambda);

/// The group at the lambda at which it takes what it may: plan_within().
/// @param lambda  of the group before
/// @param base    of the scene
[[nodiscard]] PlannedGroup plan_group_within(const TrackPlanner& planner, const GroupInput& input,
                                             double allowed_bits, double lambda, double base);

}  // namespace fbs
