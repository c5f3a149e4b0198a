// The surround's map of a scene, learned from its first pictures.
#pragma once

#include <optional>
#include <utility>

#include "encoder/surround/surround_fit.h"

namespace fbs {

class SurroundLearning {
 public:
  /// @param first  with the picture that the map moves
  /// @param still  the surround does not move: nothing is learned
  /// @param keeps  another scene keeps the map until its own pictures have shown more
  SurroundLearning(SurroundObservations first, bool still, bool keeps)
      : observations_(std::move(first)), still_(still), keeps_(keeps) {}

  /// A later picture of the scene.
  void add(const Picture& picture, const State& state) {
    if (!still_) observations_.add(picture, state);
  }
  /// Fits the map to what has been seen by now.
  void fit(const Setup& setup, const Geometry& geometry);
  /// Nothing more is learned of this scene.
  void end(const VideoFormat& format);
  /// Another scene begins, with this picture.
  void begin_again(const Picture& first, const State& state);

  [[nodiscard]] bool is_still() const { return still_; }
  [[nodiscard]] bool has_ended() const { return ended_; }
  [[nodiscard]] const SurroundMap& map() const { return map_; }
  /// The map, once after each fit.
  [[nodiscard]] std::optional<SurroundMap> take_new_map() {
    return std::exchange(is_new_, false) ? std::optional(map_) : std::nullopt;
  }

 private:
  SurroundObservations observations_;  ///< empty once learning has ended
  bool still_, keeps_;
  bool ended_ = false;
  SurroundMap map_;
  bool is_new_ = false;  ///< the map has not been taken
};

}  // namespace fbs
