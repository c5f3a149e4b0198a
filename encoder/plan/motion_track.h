// Plans and codes the motion of a scene, group by group.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bitstream/motion/motion_encoder.h"
#include "common/result.h"
#include "encoder/plan/group_plan.h"
#include "encoder/plan/rate_control.h"
#include "encoder/plan/scene_timing.h"

namespace fbs {

/// All that goes on from group to group. A value: a copy continues independently, so that the groups of a
/// segment can be planned anew from where the segment began.
class MotionTrack {
 public:
  /// @param seen  of pattern 0
  MotionTrack(const Setup& setup, const CodedState& seen, const RatePlan& rate, const SceneTiming& timing);

  struct Group {
    std::vector<State> states;          ///< of each picture, as coded
    std::vector<std::uint8_t> payload;  ///< of the motion packet
  };
  /// The next group.
  /// @param durations  of each picture, 1/90000 s; 0: nominal
  /// @return errors of MotionEncoder
  [[nodiscard]] Result<Group> add(std::span<const PictureCost> pictures,
                                  std::span<const std::uint32_t> durations);

 private:
  [[nodiscard]] MotionGroup plan(std::span<const PictureCost> pictures,
                                 std::span<const std::uint32_t> durations);

  QuantiserSteps steps_;
  SceneTiming timing_;
  MotionEncoder coder_;
  TrackPlanner planner_;
  TrackRate rate_;
  double base_lambda_;                ///< that the quality stands for
  double lambda_;                     ///< of the last group
  std::optional<RateBudget> budget_;  ///< where a rate of the motion is set
};

}  // namespace fbs
