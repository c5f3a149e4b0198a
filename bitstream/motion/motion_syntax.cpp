#include "bitstream/motion/motion_syntax.h"

#include <algorithm>
#include <cassert>

#include "bitstream/payload/setup_payload.h"

namespace fbs {
namespace {

/// Duration of the groups of a live stream as a rule, 1/90000 s.
constexpr std::int32_t kUsualGroup = kTicksPerSecond / 5;

}  // namespace

MotionReference::MotionReference(const Setup& setup, const CodedState& seen_state)
    : limits(setup.steps, setup.parts),
      nominal_duration(fbs::nominal_duration(setup.format.frame_rate)),
      seen(seen_state),
      last(seen_state) {
  assert(check_setup(setup));
  reset();
}

void MotionReference::reset() {
  static const auto before_a_scene = trained<MotionMemory>(trained_motion());
  memory = before_a_scene;
  memory.duration_history = {nominal_duration, nominal_duration};
  const auto duration = static_cast<std::int32_t>(nominal_duration);
  memory.pictures = std::clamp((2 * kUsualGroup + duration) / (2 * duration), 1, kMaxGroupPictures);
}

void MotionReference::end(const MotionGroup& group) {
  last = last_of(group);
  time += group.missing_time;
  for (const std::uint32_t duration : group.durations) time += duration;
  if (group.durations.empty()) time += static_cast<std::uint32_t>(group.pictures) * nominal_duration;
  order.end(group.first + group.pictures);
}

}  // namespace fbs
