#include "encoder/surround/surround_observations.h"

#include "encoder/image/pyramid.h"
#include "encoder/surround/surround_tuning.h"

namespace fbs {

SurroundObservations::SurroundObservations(const VideoFormat& format)
    : factor_(reduction_factor(format.width, format.height, surround::kMapLongSide)) {}

SurroundObservations::Observation SurroundObservations::observe(const Picture& picture,
                                                                const State& state) const {
  return {reduced(picture.y, factor_), state};
}

}  // namespace fbs
