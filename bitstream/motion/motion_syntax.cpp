#include "bitstream/motion/motion_syntax.h"

#include <cassert>

#include "bitstream/payload/setup_payload.h"

namespace fbs {

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
}

}  // namespace fbs
