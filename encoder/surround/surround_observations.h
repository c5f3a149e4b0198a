// The pictures from which the surround's map is learned: a few of the scene, reduced when they are added.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "common/picture.h"
#include "common/state.h"

namespace fbs {

/// Keeps the reduced luma of each picture (at most kMapLongSide samples each way), never the picture.
class SurroundObservations {
 public:
  /// A picture at 1/factor() of its size and its state, body and ground included.
  struct Observation {
    cv::Mat luma;  ///< 8 bit
    State state;
  };

  explicit SurroundObservations(const VideoFormat& format);

  /// Sets the picture that the map moves, pattern 0's. Call before the map is fitted.
  void set_first(const Picture& picture, const State& state) { first_ = observe(picture, state); }
  /// Adds a later picture; a dozen is enough.
  void add(const Picture& picture, const State& state) { later_.push_back(observe(picture, state)); }

  /// Pixels of the picture per sample kept.
  [[nodiscard]] int factor() const { return factor_; }
  [[nodiscard]] const Observation& first() const { return first_; }
  [[nodiscard]] std::span<const Observation> later() const { return later_; }

 private:
  [[nodiscard]] Observation observe(const Picture& picture, const State& state) const;

  int factor_;
  Observation first_{};
  std::vector<Observation> later_;
};

}  // namespace fbs
