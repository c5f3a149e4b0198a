// Looks for a head that the tracker has lost: in every picture around where it was last, now and then
// everywhere.
//
// A find is a place at which the picture looks like the head did in picture 0, light taken out. First a grid
// over place, turn and size is asked at the tracker's coarsest level, where a look costs microseconds; then
// the tracker settles the best of it. The cascade that looks everywhere only proposes places; the head's own
// appearance decides there too, so that a hand, a background or another face is not taken for the head.
#pragma once

#include <optional>

#include "encoder/find/face_finder.h"
#include "encoder/track/head_tracker.h"

namespace fbs {

class FaceSearch {
 public:
  /// @param finder  must outlive the object
  explicit FaceSearch(const FaceFinder& finder) : finder_(&finder) {}

  /// Correlation under which a pose is not believed: the head is lost. One who comes back elsewhere or nearer
  /// must be surer. Other people and pictures upside down reach 0.53.
  static constexpr double kLostBelow = 0.55, kSureFrom = 0.6;

  struct Find {
    TrackedPose head;  ///< the likeliest that may be: of a size near the last one's, and in the picture
    bool believed = false;
  };

  /// One lost picture, in the order in which they come.
  /// @param last      pose of the last picture in which the head was believed
  /// @param vertices  head-frame positions with the expression that is held (head units)
  [[nodiscard]] Find find(const Picture& picture, const HeadTracker& head, const Pose& last,
                          const HeadVertices& vertices);

  /// Whether the picture before was a lost one.
  [[nodiscard]] bool lost() const { return lost_pictures_ > 0; }

  /// The face is seen: the next loss begins anew.
  void rest() {
    lost_pictures_ = 0;
    suspected_.reset();
  }

 private:
  const FaceFinder* finder_;
  int lost_pictures_ = 0;
  std::optional<Pose> suspected_;  ///< where the lost picture before had something that may be the head
};

}  // namespace fbs
