// Which of the tracked changes are worth their bits: judged by the decoder's own picture.
#pragma once

#include "bitstream/motion_payload.h"
#include "common/picture.h"
#include "decoder/renderer.h"

namespace fbs {

/// Minimises D + lambda R over the states that take each part (pose, each feature) either from `before` or from
/// `tracked`. D: squared luma differences round the head between source and the decoder's picture; R: bits.
/// Starts from the better of all and nothing and changes one part at a time while that helps.
class StateChoice {
 public:
  /// @param lambda  squared grey levels per bit
  explicit StateChoice(double lambda) : lambda_(lambda) {}

  [[nodiscard]] State choose(const Scene& scene, const Picture& source, const State& before, const State& tracked,
                             const MotionCounter& counter);

 private:
  [[nodiscard]] static SampleArea region_of(const Scene& scene, const State& a, const State& b);
  [[nodiscard]] double cost(const Scene& scene, const Picture& source, const State& state, const SampleArea& region,
                            const MotionCounter& counter);

  double lambda_;
  Renderer renderer_;
  Plane drawn_;
};

}  // namespace fbs
