// Plans one motion group: its knots and lambda for a number of bits. Pure functions; the caller keeps what
// lasts from group to group.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/motion/motion_encoder.h"
#include "encoder/plan/track_planner.h"

namespace fbs {

/// Inputs of a group's plan.
struct GroupInput {
  const MotionEncoder& coder;  ///< before the group: anchor and contexts
  bool key;                    ///< whether the group is to be key
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

/// Plans the group at a fixed lambda.
[[nodiscard]] MotionGroup plan_group(const TrackPlanner& planner, const GroupInput& input, double lambda);

/// Plans the group at the lambda that meets its allowed bits: plan_within().
/// @param lambda  of the group before
/// @param base    of the scene
[[nodiscard]] PlannedGroup plan_group_within(const TrackPlanner& planner, const GroupInput& input,
                                             double allowed_bits, double lambda, double base);

}  // namespace fbs
