// Pictures for the planner: costs that are the same for every number.
#pragma once

#include <vector>

#include "bitstream/coded_state.h"
#include "encoder/model/picture_cost.h"

namespace fbs {

inline constexpr QuantiserSteps kFlatSteps{64, 16, 8, 16, 32};

/// Pictures whose fit is at zero but for the scale, and whose cost rises by `weight` for one step of any
/// number.
inline std::vector<PictureCost> flat_group(int count, double weight) {
  PictureCost picture;
  picture.layers = {{.quadratic = cv::Mat1d::zeros(kParameterCount, kParameterCount)}};
  for (int i = 0; i < kParameterCount; ++i) {
    const double step = step_of(kFlatSteps, i);
    picture.layers.front().quadratic(i, i) = weight / (step * step);
  }
  picture.fit[kLogScale] = 320.0 * step_of(kFlatSteps, kLogScale);
  return std::vector<PictureCost>(static_cast<std::size_t>(count), picture);
}

/// The state before the first picture: where the pictures of flat_group() are.
inline CodedState flat_anchor() {
  CodedState anchor{};
  anchor[kLogScale] = 320;
  return anchor;
}

inline std::array<double, kParameterCount> flat_steps() {
  std::array<double, kParameterCount> steps{};
  for (std::size_t i = 0; i < kParameterCount; ++i) steps[i] = step_of(kFlatSteps, i);
  return steps;
}

}  // namespace fbs
