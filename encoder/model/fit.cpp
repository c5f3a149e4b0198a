#include "encoder/model/fit.h"

#include <algorithm>
#include <cmath>

namespace fbs {

State state_of(const Fit& fit) {
  State state;
  const auto whole = [](double v) { return static_cast<std::int32_t>(std::lround(v)); };
  const auto pose = numbers_of(fit.pose);
  std::transform(pose.begin(), pose.end(), state.pose.begin(), whole);
  for (std::size_t i = 0; i < kLightCount; ++i) state.light[i] = whole(kLightUnitsPerLevel * fit.light[i]);
  for (std::size_t i = 0; i < kInteriorCount; ++i)
    state.interior[i] = whole(kLightUnitsPerLevel * fit.interior[i]);
  for (std::size_t c = 0; c < kControlCount; ++c)
    state.control[c] = {whole(fit.offsets[c].x), whole(fit.offsets[c].y)};
  return state;
}

Fit fit_of(const State& state) {
  Fit fit{pose_of(state), {}, {}, {}};
  for (std::size_t i = 0; i < kLightCount; ++i) fit.light[i] = state.light[i] / kLightUnitsPerLevel;
  for (std::size_t i = 0; i < kInteriorCount; ++i) fit.interior[i] = state.interior[i] / kLightUnitsPerLevel;
  for (std::size_t c = 0; c < kControlCount; ++c) fit.offsets[c] = glm::dvec2(state.control[c]);
  return fit;
}

}  // namespace fbs
