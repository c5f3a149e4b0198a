// Follows the head through the shots of a scene: tracks it, and searches it where it is lost.
#pragma once

#include <optional>

#include "encoder/track/face_search.h"

namespace fbs {

/// Holds everything about the head that lasts from picture to picture.
class HeadFollow {
 public:
  /// @param finder  searches for a lost face; must outlive the object
  /// @param first   the scene's first picture, in which the head is seen in `pose`
  /// @param eye_distance_px  in it: the scale of work frames, until another shot is framed otherwise
  /// @param any_framing  whether another shot may be framed much closer or wider
  HeadFollow(const FaceFinder& finder, const Geometry& geometry, const Pose& pose, const WorkFrame& first,
             double eye_distance_px, bool any_framing)
      : eye_distance_px_(eye_distance_px),
        any_framing_(any_framing),
        head_(geometry, pose, first),
        search_(finder) {}

  /// The work frame about a place of a picture.
  [[nodiscard]] WorkFrame frame(const Picture& picture, glm::dvec2 centre, bool with_colour) const {
    return WorkFrame::cut(picture, centre, eye_distance_px_, with_colour);
  }

  struct Found {
    Pose pose;
    WorkFrame frame;  ///< about the head, with colour
  };
  /// Follows the head to the next picture.
  /// @param last      pose in the picture before, or held there
  /// @param vertices  with the expression of the picture before (head units)
  /// @return nothing while the head is lost, or another shot does not show it
  [[nodiscard]] std::optional<Found> follow(const Picture& picture, const Pose& last,
                                            const HeadVertices& vertices);

  /// The next picture begins another shot: the head is absent until recognised.
  void cut() { elsewhere_ = true; }
  /// Whether the shot shows the head, as far as is known.
  [[nodiscard]] bool is_in_shot() const { return !elsewhere_; }
  /// Whether a picture of another shot shows the head, which is then tracked again.
  /// @param picture  to be followed next
  [[nodiscard]] bool recognises(const Picture& picture, const Pose& last, const HeadVertices& vertices);

  /// The scale of work frames: pixels.
  [[nodiscard]] double eye_distance_px() const { return eye_distance_px_; }

  /// Certainty of the last picture's pose, 0..1; of the best guess, where the head is lost.
  [[nodiscard]] double confidence() const { return confidence_; }
  [[nodiscard]] const HeadTracker& tracker() const { return head_; }

 private:
  /// Begins anew where a search has found the head.
  /// @param now  the work frame there
  void go_on_from(const Pose& pose, const WorkFrame& now);
  /// Tracks, and keeps the confidence.
  TrackedPose track(const WorkFrame& now, const HeadVertices& vertices);

  double eye_distance_px_;
  bool any_framing_;
  HeadTracker head_;
  FaceSearch search_;
  bool elsewhere_ = false;
  double confidence_ = 1;
};

}  // namespace fbs
