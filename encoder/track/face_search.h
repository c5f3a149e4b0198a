// Searches for a head that the tracker has lost: in every picture around its last place, now and then
// everywhere.
#pragma once

#include <optional>

#include "encoder/find/face_finder.h"
#include "encoder/track/head/head_tuning.h"
#include "encoder/track/head_tracker.h"

namespace fbs {

/// A detection is a place where the picture resembles the head in picture 0, light levelled out. First a grid
/// over place, rotation and size is tried at the coarsest level; then its best are refined. Faces found
/// everywhere are only candidates; the head's own appearance decides there too, so that another face is not
/// taken for the head.
class FaceSearch {
 public:
  /// Correlation below which the head is lost.
  static constexpr double kLostBelow = head_tuning::kLostBelow;

  struct Detection {
    TrackedPose head;  ///< the likeliest plausible one: of a size near the last one's, and in the picture
    bool accepted = false;
  };

  /// @param finder  must outlive the object
  explicit FaceSearch(const FaceFinder& finder) : finder_(&finder) {}

  /// Searches one lost picture; call in order.
  /// @param last      pose of the last picture in which the head was accepted
  /// @param vertices  head-frame positions with the expression held meanwhile (head units)
  [[nodiscard]] Detection find(const Picture& picture, const HeadTracker& head, const Pose& last,
                               const HeadVertices& vertices);

  /// Searches faces anywhere, and nowhere else: for the first picture of another shot.
  /// @param size_change  most that the head may have there, log2 against the last pose
  [[nodiscard]] Detection find_anywhere(const Picture& picture, const HeadTracker& head, const Pose& last,
                                        const HeadVertices& vertices, double size_change) const;

  /// Whether the picture before was lost.
  [[nodiscard]] bool lost() const { return lost_pictures_ > 0; }

  /// Call when the face is seen: the next loss starts over.
  void rest() {
    lost_pictures_ = 0;
    suspected_.reset();
  }

 private:
  const FaceFinder* finder_;
  int lost_pictures_ = 0;
  std::optional<Pose> suspected_;  ///< candidate of the lost picture before
};

}  // namespace fbs
