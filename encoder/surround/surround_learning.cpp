#include "encoder/surround/surround_learning.h"

#include "decoder/animate/surround.h"

namespace fbs {

void SurroundLearning::fit(const Setup& setup, const Geometry& geometry) {
  const bool keeps = keeps_ && map_.columns > 0 && observations_.later().empty();
  if (still_)
    map_ = still_surround();
  else if (!keeps)
    map_ = fit_surround(setup, geometry, observations_);
  is_new_ = true;
}

void SurroundLearning::end(const VideoFormat& format) {
  observations_ = SurroundObservations(format);
  ended_ = true;
}

void SurroundLearning::begin_again(const Picture& first, const State& state) {
  observations_.set_first(first, state);
  ended_ = false;
}

}  // namespace fbs
