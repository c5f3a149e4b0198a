// Estimates the cost of patterns at an operating point from a few coded on trial.
#pragma once

#include <span>

#include "encoder/patterns/pattern_sequence.h"

namespace fbs {

struct PatternCost {
  double first_bytes = 0;    ///< of the key frame
  double later_bytes = 0;    ///< of each other pattern, mean
  double squared_error = 0;  ///< luma, mean over samples
};

/// @param pictures  consecutive patterns of the scene, 2..kMaxSequencePictures
Result<PatternCost> trial_cost(const VideoFormat& format, std::span<const Picture> pictures,
                               const SequenceSettings& settings);

}  // namespace fbs
