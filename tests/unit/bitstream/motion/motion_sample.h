// A scene's motion for tests: setups, a seen state, and random groups in stream order.
#pragma once

#include <algorithm>
#include <random>

#include "bitstream/motion/motion_encoder.h"
#include "tests/unit/bitstream/random_tracks.h"

namespace fbs {

inline constexpr PartMask kPoseOnly = mask_of(PartId::kPose);
inline constexpr auto kSomeParts = static_cast<PartMask>(kPoseOnly | mask_of(PartId::kGround) |
                                                         mask_of(PartId::kMouth) | mask_of(PartId::kGaze));

inline Setup sample_setup(PartMask parts = kAllParts) {
  Setup setup;
  setup.format.width = 352;
  setup.format.height = 288;
  setup.format.frame_rate = {30, 1};
  setup.parts = parts;
  return setup;
}

/// Seen state of pattern 0: an eye distance of some 50 pixels.
inline CodedState sample_seen(const Setup& setup) {
  CodedState seen{};
  seen[kLogScale] = std::min(2900, CodedLimits(setup.steps, setup.parts).max[kLogScale]);
  return seen;
}

/// An encoder, and random groups for it.
struct Sender {
  explicit Sender(const Setup& setup, unsigned seed = 1)
      : seen(sample_seen(setup)), encoder(setup, seen), random(seed) {}

  /// A group that can be coded next.
  MotionGroup next(const TrackHabits& habits, std::int32_t pictures, bool key = false) {
    MotionGroup group = random_group(random, encoder.limits(), encoder.anchor(), pictures, habits);
    group.key = key || encoder.groups() == 0;
    group.first = encoder.next();
    return group;
  }

  CodedState seen;
  MotionEncoder encoder;
  std::mt19937 random;
};

}  // namespace fbs
