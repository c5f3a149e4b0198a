// What --quality means: the pattern's quantiser, the state's steps and lambda, moved together.
#pragma once

#include "common/state.h"

namespace fbs {

struct OperatingPoint {
  int pattern_quantiser;  ///< libaom's scale, 0..63
  QuantiserSteps steps;
  double lambda;  ///< squared luma levels per bit of motion

  /// @param quality          0..100
  /// @param eye_distance_px  in the scene's first picture: steps are fractions of a pixel on the face
  static OperatingPoint at(int quality, double eye_distance_px);
};

}  // namespace fbs
