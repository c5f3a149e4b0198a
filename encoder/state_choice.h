// Which of the tracked changes are worth their bits: judged at PictureFit's points by what the decoder will
// show.
#pragma once

#include <span>

#include "bitstream/motion_payload.h"
#include "encoder/picture_fit.h"

namespace fbs {

/// Minimises D + lambda R over the states that take each part (pose, each feature) from one of the
/// candidates. D: squared luma differences over the face, from PictureFit; R: bits, and what a viewer sees of
/// lips and lids away from where the last candidate has them, as bits. Starts from the best whole candidate
/// and changes one part at a time while that helps.
/// @param candidates  at least one; the first is what holding costs least: the state before
/// @param lambda      squared grey levels per bit
[[nodiscard]] State choose_state(std::span<const State> candidates, const PictureFit& fit,
                                 const MotionCounter& counter, double lambda);

}  // namespace fbs
